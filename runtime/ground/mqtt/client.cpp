#include "runtime/ground/mqtt/client.h"

#include <mosquitto.h>

#include <algorithm>
#include <cerrno>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <fstream>
#include <limits>
#include <mutex>
#include <thread>
#include <utility>

namespace stepwright::mqtt {

namespace {

constexpr int kTurn_ms = 200;
constexpr std::chrono::seconds kTimeToEnd{1};  // for what is still to be sent at the end

// What the library's codes say of the cause; errno is still that of the call.
Trouble trouble_of(int code, const std::string& told) {
  const std::string why = code == MOSQ_ERR_ERRNO ? std::strerror(errno) : mosquitto_strerror(code);
  switch (code) {
    case MOSQ_ERR_EAI:
      return {TroubleKind::NoHost, "no machine of that name is known"};
    case MOSQ_ERR_TLS:
    case MOSQ_ERR_TLS_HANDSHAKE:
      return {TroubleKind::Tls, told.empty() ? why : told};
    default:
      return {TroubleKind::Unreachable, why};
  }
}

}  // namespace

// At one place in memory: the library calls back with its address, on the thread of `serve`.
class Client::Connection {
 public:
  explicit Connection(const Options& options) : options_(options) {
    mosquitto_lib_init();  // counted by the library
    handle_ = mosquitto_new(options_.client_id.empty() ? nullptr : options_.client_id.c_str(), true, this);
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection() {
    if (thread_.joinable()) {
      {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        give_up_ = std::chrono::steady_clock::now() + kTimeToEnd;
      }
      wake_.notify_all();
      mosquitto_disconnect(handle_);
      thread_.join();
    }
    if (handle_ != nullptr) mosquitto_destroy(handle_);
    mosquitto_lib_cleanup();
  }

  // What the library says of a wrong option; nothing if all is well.
  std::optional<std::string> start() {
    if (handle_ == nullptr) return "no memory, or no client id";
    const int code = set_up();
    if (code != MOSQ_ERR_SUCCESS) return mosquitto_strerror(code);
    mosquitto_threaded_set(handle_, true);
    mosquitto_connect_callback_set(handle_, &Connection::on_connect);
    mosquitto_message_callback_set(handle_, &Connection::on_message);
    mosquitto_log_callback_set(handle_, &Connection::on_log);
    thread_ = std::thread([this] { serve(); });
    return std::nullopt;
  }

  void subscribe(const std::string& filter, int qos) {
    const std::lock_guard lock(mutex_);
    filters_.emplace_back(filter, qos);
    if (connected_) mosquitto_subscribe(handle_, nullptr, filter.c_str(), qos);
  }

  bool publish(const std::string& topic, std::string_view payload, int qos, bool retained) {
    if (payload.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) return false;
    return connected() && mosquitto_publish(handle_, nullptr, topic.c_str(), static_cast<int>(payload.size()),
                                            payload.data(), qos, retained) == MOSQ_ERR_SUCCESS;
  }

  std::vector<Message> take(std::chrono::milliseconds wait) {
    std::unique_lock lock(mutex_);
    came_.wait_for(lock, wait, [&] { return !waiting_.empty(); });
    std::vector<Message> messages(std::make_move_iterator(waiting_.begin()),
                                  std::make_move_iterator(waiting_.end()));
    waiting_.clear();
    return messages;
  }

  bool connected() const {
    const std::lock_guard lock(mutex_);
    return connected_;
  }
  std::optional<Trouble> trouble() const {
    const std::lock_guard lock(mutex_);
    return connected_ ? std::nullopt : trouble_;
  }
  std::size_t connections() const {
    const std::lock_guard lock(mutex_);
    return connections_;
  }
  std::size_t dropped() const {
    const std::lock_guard lock(mutex_);
    return dropped_;
  }

 private:
  int set_up() {
    int code = MOSQ_ERR_SUCCESS;
    if (!options_.user.empty()) {
      code = mosquitto_username_pw_set(handle_, options_.user.c_str(), options_.password.c_str());
    }
    if (code == MOSQ_ERR_SUCCESS && options_.will) {
      const Will& will = *options_.will;
      code = mosquitto_will_set(handle_, will.topic.c_str(), static_cast<int>(will.payload.size()),
                                will.payload.data(), will.qos, will.retained);
    }
    if (code == MOSQ_ERR_SUCCESS && options_.tls) code = set_up_tls(*options_.tls);
    return code;
  }

  int set_up_tls(const Tls& tls) {
    const auto file = [](const std::string& name) { return name.empty() ? nullptr : name.c_str(); };
    const char* const system = tls.ca_file.empty() ? "/etc/ssl/certs" : nullptr;
    return mosquitto_tls_set(handle_, file(tls.ca_file), system, file(tls.certificate_file),
                             file(tls.key_file), nullptr);
  }

  // One attempt after the other, each until its connection ends.
  void serve() {
    auto pause = std::chrono::duration_cast<std::chrono::milliseconds>(options_.reconnect_least);
    for (bool first = true;; first = false) {
      const bool was_connected = serve_once(first);
      std::unique_lock lock(mutex_);
      connected_ = false;
      if (was_connected) pause = options_.reconnect_least;
      if (wake_.wait_for(lock, pause, [&] { return stopping_; })) return;
      pause = std::min<std::chrono::milliseconds>(2 * pause, options_.reconnect_most);
    }
  }

  // True if the broker took the connection.
  bool serve_once(bool first) {
    told_.clear();
    refused_ = 0;
    const std::size_t before = connections();
    int code = first ? mosquitto_connect_async(handle_, options_.host.c_str(), options_.port,
                                               static_cast<int>(options_.keep_alive.count()))
                     : mosquitto_reconnect_async(handle_);
    while (code == MOSQ_ERR_SUCCESS && !over()) code = mosquitto_loop(handle_, kTurn_ms, 1);
    Trouble trouble = trouble_of(code, told_);
    if (refused_ != 0) trouble = {TroubleKind::Refused, mosquitto_connack_string(refused_)};
    const std::lock_guard lock(mutex_);
    trouble_ = std::move(trouble);
    return connections_ > before;
  }

  bool over() const {
    const std::lock_guard lock(mutex_);
    return stopping_ && (!connected_ || std::chrono::steady_clock::now() > give_up_);
  }

  static void on_connect(mosquitto* handle, void* self, int code) {
    auto& connection = *static_cast<Connection*>(self);
    connection.refused_ = code;
    if (code != 0) return;
    const std::lock_guard lock(connection.mutex_);
    connection.connected_ = true;
    ++connection.connections_;
    for (const auto& [filter, qos] : connection.filters_) {
      mosquitto_subscribe(handle, nullptr, filter.c_str(), qos);
    }
  }

  // The library says what is wrong with certificates here and nowhere else; the first line says most.
  static void on_log(mosquitto*, void* self, int level, const char* text) {
    auto& connection = *static_cast<Connection*>(self);
    if (level == MOSQ_LOG_ERR && connection.told_.empty()) connection.told_ = text;
  }

  static void on_message(mosquitto*, void* self, const mosquitto_message* message) {
    auto& connection = *static_cast<Connection*>(self);
    const auto* const bytes = static_cast<const char*>(message->payload);
    Message copy{.topic = message->topic, .payload = {}, .retained = message->retain};
    if (message->payloadlen > 0) copy.payload.assign(bytes, static_cast<std::size_t>(message->payloadlen));
    const std::lock_guard lock(connection.mutex_);
    if (connection.waiting_.size() == connection.options_.most_waiting) {
      connection.waiting_.pop_front();
      ++connection.dropped_;
    }
    connection.waiting_.push_back(std::move(copy));
    connection.came_.notify_one();
  }

  Options options_;
  mosquitto* handle_ = nullptr;
  std::thread thread_;
  std::string told_;          // by the library in this attempt; on the thread of `serve` only, as is the next
  int refused_ = 0;           // the broker's word
  mutable std::mutex mutex_;  // of everything below
  std::condition_variable came_, wake_;
  std::deque<Message> waiting_;
  std::vector<std::pair<std::string, int>> filters_;
  std::optional<Trouble> trouble_;
  std::chrono::steady_clock::time_point give_up_{};
  bool stopping_ = false;
  bool connected_ = false;
  std::size_t connections_ = 0;
  std::size_t dropped_ = 0;
};

Client::Client(std::unique_ptr<Connection> connection) : connection_(std::move(connection)) {}
Client::Client(Client&&) noexcept = default;
Client& Client::operator=(Client&&) noexcept = default;
Client::~Client() = default;

result::Result<Client> Client::open(const Options& options) {
  if (options.tls) {
    for (const std::string& file :
         {options.tls->ca_file, options.tls->certificate_file, options.tls->key_file}) {
      if (file.empty() || std::ifstream(file).good()) continue;
      return result::fail("MQ002", {file, 0, 0}, std::string("cannot be read: ") + std::strerror(errno),
                          "TLS needs certificates and keys as PEM files that this user may read");
    }
  }
  auto connection = std::make_unique<Connection>(options);
  if (const auto wrong = connection->start()) {
    return result::fail("MQ001", {}, "MQTT client of " + options.host + ": " + *wrong,
                        options.tls ? "do certificate and key come together?" : "");
  }
  return Client(std::move(connection));
}

bool Client::connected() const {
  return connection_->connected();
}

std::optional<Trouble> Client::trouble() const {
  return connection_->trouble();
}

std::size_t Client::connections() const {
  return connection_->connections();
}

std::size_t Client::dropped() const {
  return connection_->dropped();
}

void Client::subscribe(const std::string& filter, int qos) {
  connection_->subscribe(filter, qos);
}

bool Client::publish(const std::string& topic, std::string_view payload, int qos, bool retained) {
  return connection_->publish(topic, payload, qos, retained);
}

std::vector<Message> Client::take(std::chrono::milliseconds wait) {
  return connection_->take(wait);
}

}  // namespace stepwright::mqtt
