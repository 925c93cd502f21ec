#include "runtime/dds/internal/client_session.h"

#include <utility>

#include "runtime/dds/internal/socket_only.h"
#include "runtime/dds/internal/topics.h"

namespace stepwright::dds::internal {
namespace {

using namespace std::chrono_literals;

// An answer takes well under a millisecond; what takes longer was lost with a process that died.
constexpr std::chrono::milliseconds kResendPeriod{200};
// An event that the status already names is usually on its way: give it this long before asking for it.
constexpr std::chrono::milliseconds kEventGrace{30};
// Within which a supervisor that was killed is known to be gone, and how often its successor asks.
constexpr std::chrono::milliseconds kClaimPatience{2'000};
constexpr std::chrono::milliseconds kClaimPause{100};

}  // namespace

ClientSession::ClientSession(std::unique_ptr<Participant> participant, ClientRole role, std::uint64_t client,
                             std::string place, const std::string& process)
    : participant_(std::move(participant)),
      place_(std::move(place)),
      requests_(client, role == ClientRole::Supervisor),
      namesakes_(*participant_),
      request_writer_(*participant_, kRequestTopic, Profile::Queue),
      reply_reader_(*participant_, kReplyTopic, Profile::Queue,
                    {.on_message = [this](service::Reply reply) { requests_.answer(std::move(reply)); }}),
      event_reader_(*participant_, kEventTopic, Profile::Queue,
                    {.on_message = [this](StepEvent event) { on_event(std::move(event)); }}),
      snapshot_reader_(*participant_, kSnapshotTopic, Profile::Picture,
                       {.on_message = [this](Snapshot snapshot) { on_snapshot(std::move(snapshot)); }}),
      health_reader_(*participant_, kHealthTopic, Profile::Picture,
                     {.on_message = [this](RuntimeHealth health) { on_health(std::move(health)); }}),
      status_reader_(*participant_, kStatusTopic, Profile::Heartbeat,
                     {.on_message = [this](service::LinkStatus news) { on_status(std::move(news)); },
                      .on_alive = [this](bool) { news_.notify_all(); },
                      .on_other_version = [this](std::uint32_t version) { on_other_version(version); }}) {
  if (role != ClientRole::Supervisor) return;
  presence_ =
      std::make_unique<MessageWriter<service::Presence>>(*participant_, kPresenceTopic, Profile::Heartbeat);
  if (!presence_->ok()) return;
  heart_ =
      std::jthread([this, process, client](const std::stop_token& stop) { beat(stop, process, client); });
}

void ClientSession::beat(const std::stop_token& stop, const std::string& process, std::uint64_t client) {
  std::mutex mutex;
  std::condition_variable_any never;
  std::unique_lock lock(mutex);
  while (!stop.stop_requested()) {
    presence_->write({process, client});
    never.wait_for(lock, stop, kHeartbeatPeriod, [] { return false; });
  }
}

bool ClientSession::ok() const {
  return namesakes_.ok() && request_writer_.ok() && reply_reader_.ok() && event_reader_.ok() &&
         snapshot_reader_.ok() && health_reader_.ok() && status_reader_.ok() &&
         (presence_ == nullptr || presence_->ok());
}

bool ClientSession::runtime_alive() const {
  const std::scoped_lock lock(mutex_);
  return runtime_connected_ && status_reader_.alive();
}

bool ClientSession::wait_for_runtime(std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  return news_.wait_for(lock, timeout, [this] { return reachable(); });
}

bool ClientSession::reachable() const {
  return runtime_connected_ && events_.started() && status_reader_.alive() && request_writer_.matched();
}

// A supervisor that is gone is noticed a moment later: whoever comes in its place asks again.
result::Result<service::Reply> ClientSession::ask(service::RequestBody body) {
  if (service::is_for_the_socket_only(body)) return ask_on_the_socket();
  const auto deadline = Clock::now() + kClaimPatience;
  while (true) {
    auto reply = ask_once(body);
    const bool held = !reply && reply.error().front().code == kHeldByAnother;
    if (!held || Clock::now() >= deadline) return reply;
    std::this_thread::sleep_for(kClaimPause);
  }
}

tl::unexpected<result::Diagnostics> ClientSession::other_version() const {
  return result::fail(service::kOtherVersion, {},
                      "the link of '" + participant_->runtime_id() + "' speaks version " +
                          std::to_string(other_version_.value_or(0)) +
                          " of the protocol, and this program version " +
                          std::to_string(service::kProtocolVersion) + ": nothing was sent",
                      "start both with the same version of Stepwright");
}

tl::unexpected<result::Diagnostics> ClientSession::nobody_answers() const {
  std::string hint = "are the processes 'runtime' and 'link' of the cell running?";
  if (const auto elsewhere = namesakes_.places(place_); !elsewhere.empty() && !place_.empty()) {
    hint = "one of that name lives at " + elsewhere.front() + ", and this one is looked for at " + place_ +
           ": [dds] place names another place, \"any\" all of them";
  }
  return result::fail(service::kNobodyAnswers, {},
                      "no runtime '" + participant_->runtime_id() + "' answers on Fast DDS", hint);
}

result::Result<service::Reply> ClientSession::ask_once(const service::RequestBody& body) {
  const auto deadline = Clock::now() + kRequestTimeout;
  // Where this client's events start must be known before it causes any.
  {
    std::unique_lock lock(mutex_);
    news_.wait_for(lock, kRequestTimeout, [this] { return reachable() || link_is_of_another_version(); });
    if (link_is_of_another_version()) return other_version();
    if (!reachable()) return nobody_answers();
  }
  const auto longest =
      std::holds_alternative<service::DownloadCommit>(body) ? Clock::now() + kDownloadTimeout : deadline;
  const service::Request request = requests_.open(body);
  std::optional<service::Reply> reply;
  for (auto now = Clock::now(); !reply && (now < deadline || (now < longest && runtime_alive()));
       now = Clock::now()) {
    request_writer_.write(request);
    reply = requests_.wait(request.id, kResendPeriod);
  }
  requests_.forget(request.id);
  if (!reply) {
    return result::fail(service::kNobodyAnswers, {},
                        "the runtime '" + participant_->runtime_id() + "' does not answer");
  }
  if (!reply->accepted()) return tl::unexpected(std::move(reply->problems));
  return std::move(*reply);
}

std::optional<StepEvent> ClientSession::wait_event(std::chrono::milliseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  std::unique_lock lock(mutex_);
  while (true) {
    if (auto event = events_.take()) return event;
    const auto now = Clock::now();
    if (now >= deadline) return std::nullopt;
    auto until = deadline;
    if (events_.missing()) {
      if (fetch_at_ == Clock::time_point{}) fetch_at_ = now + kEventGrace;
      if (now >= fetch_at_) fetch_missing(lock);
      until = std::min(deadline, fetch_at_);
    } else {
      fetch_at_ = {};
    }
    news_.wait_until(lock, until);
  }
}

void ClientSession::fetch_missing(std::unique_lock<std::mutex>& lock) {
  const std::uint64_t open = fetch_id_;
  const std::uint64_t first = events_.missing().value_or(0);
  lock.unlock();
  std::optional<service::Reply> reply;
  if (open != 0) {
    reply = requests_.wait(open, 0ms);
    requests_.forget(open);
  }
  const service::Request request = requests_.open(service::ResendEvents{first});
  request_writer_.write(request);
  lock.lock();
  fetch_id_ = request.id;
  fetch_at_ = Clock::now() + kResendPeriod;
  // The answer's offset is the first event that the runtime still holds.
  if (reply && reply->accepted()) events_.skip_to(reply->offset);
}

void ClientSession::on_status(service::LinkStatus news) {
  {
    const std::scoped_lock lock(mutex_);
    other_version_.reset();
    runtime_connected_ = news.runtime_connected;
    if (runtime_connected_) {
      events_.observe(news.status);
      status_ = std::move(news.status);
    }
  }
  news_.notify_all();
}

void ClientSession::on_other_version(std::uint32_t version) {
  {
    const std::scoped_lock lock(mutex_);
    other_version_ = version;
    runtime_connected_ = false;
  }
  news_.notify_all();
}

void ClientSession::on_event(StepEvent event) {
  {
    const std::scoped_lock lock(mutex_);
    events_.add(std::move(event));
  }
  news_.notify_all();
}

void ClientSession::on_snapshot(Snapshot snapshot) {
  {
    const std::scoped_lock lock(mutex_);
    snapshot_ = std::move(snapshot);
    snapshot_is_new_ = true;
  }
  snapshot_news_.notify_all();
}

void ClientSession::on_health(RuntimeHealth health) {
  const std::scoped_lock lock(mutex_);
  health_ = std::move(health);
}

std::optional<RuntimeHealth> ClientSession::health() const {
  const std::scoped_lock lock(mutex_);
  return health_;
}

std::vector<TopicTraffic> ClientSession::traffic() const {
  return {status_reader_.traffic(), snapshot_reader_.traffic(), event_reader_.traffic(),
          health_reader_.traffic(), reply_reader_.traffic()};
}

std::optional<RuntimeStatus> ClientSession::status() const {
  const std::scoped_lock lock(mutex_);
  return status_;
}

std::optional<Snapshot> ClientSession::snapshot() const {
  const std::scoped_lock lock(mutex_);
  return snapshot_;
}

bool ClientSession::wait_snapshot(std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  snapshot_news_.wait_for(lock, timeout, [this] { return snapshot_is_new_; });
  return std::exchange(snapshot_is_new_, false);
}

}  // namespace stepwright::dds::internal
