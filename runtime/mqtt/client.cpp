#include "runtime/mqtt/client.h"

#include <mosquitto.h>

#include <condition_variable>
#include <deque>
#include <limits>
#include <mutex>
#include <utility>

namespace stepwright::mqtt {

// At one place in memory: the library's thread calls back with its address.
class Client::Connection {
 public:
  explicit Connection(const Options& options) : options_(options) {
    mosquitto_lib_init();  // counted by the library
    handle_ = mosquitto_new(options_.client_id.empty() ? nullptr : options_.client_id.c_str(), true, this);
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection() {
    if (handle_ != nullptr) {
      mosquitto_disconnect(handle_);
      if (running_) mosquitto_loop_stop(handle_, false);
      mosquitto_destroy(handle_);
    }
    mosquitto_lib_cleanup();
  }

  // What the library says of a wrong option; nothing if all is well.
  std::optional<std::string> start() {
    if (handle_ == nullptr) return "no memory, or no client id";
    int code = set_up();
    if (code == MOSQ_ERR_SUCCESS) {
      mosquitto_connect_callback_set(handle_, &Connection::on_connect);
      mosquitto_disconnect_callback_set(handle_, &Connection::on_disconnect);
      mosquitto_message_callback_set(handle_, &Connection::on_message);
      code = mosquitto_connect_async(handle_, options_.host.c_str(), options_.port,
                                     static_cast<int>(options_.keep_alive.count()));
      // Whether the broker is there is for the thread to find out.
      if (code == MOSQ_ERR_INVAL) return mosquitto_strerror(code);
      code = mosquitto_loop_start(handle_);
      running_ = code == MOSQ_ERR_SUCCESS;
    }
    if (code == MOSQ_ERR_SUCCESS) return std::nullopt;
    return mosquitto_strerror(code);
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
    int code = mosquitto_reconnect_delay_set(handle_, static_cast<unsigned>(options_.reconnect_least.count()),
                                             static_cast<unsigned>(options_.reconnect_most.count()), true);
    if (code == MOSQ_ERR_SUCCESS && !options_.user.empty()) {
      code = mosquitto_username_pw_set(handle_, options_.user.c_str(), options_.password.c_str());
    }
    if (code == MOSQ_ERR_SUCCESS && options_.will) {
      const Will& will = *options_.will;
      code = mosquitto_will_set(handle_, will.topic.c_str(), static_cast<int>(will.payload.size()),
                                will.payload.data(), will.qos, will.retained);
    }
    if (code == MOSQ_ERR_SUCCESS && options_.tls) {
      const auto file = [](const std::string& name) { return name.empty() ? nullptr : name.c_str(); };
      code = mosquitto_tls_set(handle_, file(options_.tls->ca_file), nullptr,
                               file(options_.tls->certificate_file), file(options_.tls->key_file), nullptr);
    }
    return code;
  }

  static void on_connect(mosquitto* handle, void* self, int code) {
    if (code != 0) return;  // refused; the library tries again
    auto& connection = *static_cast<Connection*>(self);
    const std::lock_guard lock(connection.mutex_);
    connection.connected_ = true;
    ++connection.connections_;
    for (const auto& [filter, qos] : connection.filters_) {
      mosquitto_subscribe(handle, nullptr, filter.c_str(), qos);
    }
  }

  static void on_disconnect(mosquitto*, void* self, int) {
    auto& connection = *static_cast<Connection*>(self);
    const std::lock_guard lock(connection.mutex_);
    connection.connected_ = false;
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
  bool running_ = false;
  mutable std::mutex mutex_;  // of everything below
  std::condition_variable came_;
  std::deque<Message> waiting_;
  std::vector<std::pair<std::string, int>> filters_;
  bool connected_ = false;
  std::size_t connections_ = 0;
  std::size_t dropped_ = 0;
};

Client::Client(std::unique_ptr<Connection> connection) : connection_(std::move(connection)) {}
Client::Client(Client&&) noexcept = default;
Client& Client::operator=(Client&&) noexcept = default;
Client::~Client() = default;

result::Result<Client> Client::open(const Options& options) {
  auto connection = std::make_unique<Connection>(options);
  if (const auto wrong = connection->start()) {
    return result::fail("MQ001", {}, "MQTT client of " + options.host + ": " + *wrong,
                        options.tls ? "are the files of TLS there and readable?" : "");
  }
  return Client(std::move(connection));
}

bool Client::connected() const {
  return connection_->connected();
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
