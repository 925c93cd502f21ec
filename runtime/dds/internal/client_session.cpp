#include "runtime/dds/internal/client_session.h"

#include <utility>

#include "runtime/dds/internal/convert.h"
#include "runtime/dds/internal/topics.h"

namespace stepwright::dds::internal {
namespace {

using namespace std::chrono_literals;

// An answer takes well under a millisecond; what takes longer was lost with a process that died.
constexpr std::chrono::milliseconds kResendPeriod{200};
// An event that the status already names is usually on its way: give it this long before asking for it.
constexpr std::chrono::milliseconds kEventGrace{30};
// Within which the endpoints of a link that has just come are all found.
constexpr std::chrono::milliseconds kExtraGrace{1'000};
constexpr std::chrono::milliseconds kExtraLook{5};
// Within which a supervisor that was killed is known to be gone, and how often its successor asks.
constexpr std::chrono::milliseconds kClaimPatience{2'000};
constexpr std::chrono::milliseconds kClaimPause{100};

}  // namespace

ClientSession::ClientSession(std::unique_ptr<Participant> participant, ClientRole role, std::uint64_t client,
                             std::string place, const std::string& process)
    : participant_(std::move(participant)),
      place_(std::move(place)),
      supervises_(role == ClientRole::Supervisor),
      requests_(client),
      namesakes_(*participant_),
      commands_(*participant_, kCommandTopic, Profile::Queue),
      chunks_(*participant_, kChunkTopic, Profile::Queue),
      extras_(*participant_, kExtraTopic, Profile::Queue),
      reply_reader_(*participant_, kReplyTopic, Profile::Queue,
                    [this](idl::Reply& sample) {
                      auto reply = from_reply(sample);
                      if (!reply) return reply_reader_.refuse();
                      requests_.answer(std::move(*reply));
                    }),
      event_reader_(*participant_, kEventTopic, Profile::Queue,
                    [this](idl::Event& sample) { on_event(sample); }),
      snapshot_reader_(*participant_, kSnapshotTopic, Profile::Picture,
                       [this](idl::Snapshot& sample) { on_snapshot(sample); }),
      health_reader_(*participant_, kHealthTopic, Profile::Picture,
                     [this](idl::Health& sample) { on_health(sample); }),
      status_reader_(
          *participant_, kStatusTopic, Profile::Heartbeat, [this](idl::Status& sample) { on_status(sample); },
          [this](bool) { news_.notify_all(); }) {
  if (role != ClientRole::Supervisor) return;
  presence_ =
      std::make_unique<Writer<idl::PresencePubSubType>>(*participant_, kPresenceTopic, Profile::Heartbeat);
  if (!presence_->ok()) return;
  heart_ =
      std::jthread([this, process, client](const std::stop_token& stop) { beat(stop, process, client); });
}

void ClientSession::beat(const std::stop_token& stop, const std::string& process, std::uint64_t client) {
  idl::Presence sample;
  sample.runtime_id(participant_->runtime_id());
  sample.process(process);
  sample.client(client);
  std::mutex mutex;
  std::condition_variable_any never;
  std::unique_lock lock(mutex);
  while (!stop.stop_requested()) {
    presence_->write(sample);
    never.wait_for(lock, stop, kHeartbeatPeriod, [] { return false; });
  }
}

bool ClientSession::ok() const {
  return namesakes_.ok() && commands_.ok() && chunks_.ok() && extras_.ok() && reply_reader_.ok() &&
         event_reader_.ok() && snapshot_reader_.ok() && health_reader_.ok() && status_reader_.ok() &&
         (presence_ == nullptr || presence_->ok());
}

bool ClientSession::runtime_alive() const {
  const std::scoped_lock lock(mutex_);
  return runtime_connected_ && status_reader_.alive();
}

bool ClientSession::wait_for_runtime(std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  return news_.wait_for(lock, timeout, [this] {
    return runtime_connected_ && events_.started() && status_reader_.alive() && commands_.matched();
  });
}

// A supervisor that is gone is noticed a moment later: whoever comes in its place asks again.
result::Result<service::Reply> ClientSession::ask(service::RequestBody body) {
  if (!travels(body)) return result::fail("R0002", {}, "this is asked on the socket of the runtime only");
  const auto deadline = Clock::now() + kClaimPatience;
  while (true) {
    auto reply = ask_once(body);
    const bool held = !reply && reply.error().front().code == kHeldByAnother;
    if (!held || Clock::now() >= deadline) return reply;
    std::this_thread::sleep_for(kClaimPause);
  }
}

tl::unexpected<result::Diagnostics> ClientSession::nobody_answers() const {
  std::string hint = "are the processes 'runtime' and 'link' of the cell running?";
  if (const auto elsewhere = namesakes_.places(place_); !elsewhere.empty() && !place_.empty()) {
    hint = "one of that name lives at " + elsewhere.front() + ", and this one is looked for at " + place_ +
           ": [dds] place names another place, \"any\" all of them";
  }
  return result::fail("D0001", {}, "no runtime '" + participant_->runtime_id() + "' answers on Fast DDS",
                      hint);
}

result::Result<service::Reply> ClientSession::ask_once(const service::RequestBody& body) {
  const auto deadline = Clock::now() + kRequestTimeout;
  // Where this client's events start must be known before it causes any.
  if (!wait_for_runtime(kRequestTimeout)) return nobody_answers();
  if (link_is_older(body)) {
    return result::fail("D0008", {},
                        "the link of '" + participant_->runtime_id() + "' does not carry this request",
                        "it is of another version: start both with the same one");
  }
  const auto longest =
      std::holds_alternative<service::DownloadCommit>(body) ? Clock::now() + kDownloadTimeout : deadline;
  const service::Request request = requests_.open(body);
  std::optional<service::Reply> reply;
  for (auto now = Clock::now(); !reply && (now < deadline || (now < longest && runtime_alive()));
       now = Clock::now()) {
    send(request);
    reply = requests_.wait(request.id, kResendPeriod);
  }
  requests_.forget(request.id);
  if (!reply) {
    return result::fail("D0001", {}, "the runtime '" + participant_->runtime_id() + "' does not answer");
  }
  if (!reply->accepted()) return tl::unexpected(std::move(reply->problems));
  return std::move(*reply);
}

// Endpoints of one process are found one after another: that the extra one is missing means something only
// some time after the others were found.
bool ClientSession::link_is_older(const service::RequestBody& body) const {
  if (!is_extra(body)) return false;
  const auto deadline = Clock::now() + kExtraGrace;
  while (!extras_.matched() && Clock::now() < deadline) std::this_thread::sleep_for(kExtraLook);
  return !extras_.matched();
}

bool ClientSession::send(const service::Request& request) {
  if (is_extra(request.body)) {
    auto sample = to_extra(participant_->runtime_id(), request);
    sample.supervisor(supervises_);
    return extras_.write(sample);
  }
  if (std::holds_alternative<service::DownloadChunk>(request.body)) {
    auto sample = to_chunk(participant_->runtime_id(), request);
    sample.supervisor(supervises_);
    return chunks_.write(sample);
  }
  auto sample = to_command(participant_->runtime_id(), request);
  sample.supervisor(supervises_);
  return commands_.write(sample);
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
  send(request);
  lock.lock();
  fetch_id_ = request.id;
  fetch_at_ = Clock::now() + kResendPeriod;
  // The answer's offset is the first event that the runtime still holds.
  if (reply && reply->accepted()) events_.skip_to(reply->offset);
}

void ClientSession::on_status(const idl::Status& sample) {
  auto status = from_status(sample);
  if (!status) return status_reader_.refuse();
  {
    const std::scoped_lock lock(mutex_);
    runtime_connected_ = sample.runtime_connected();
    if (runtime_connected_) {
      events_.observe(*status);
      status_ = std::move(status);
    }
  }
  news_.notify_all();
}

void ClientSession::on_event(const idl::Event& sample) {
  auto event = from_event(sample);
  if (!event) return event_reader_.refuse();
  event->incarnation = sample.incarnation();
  {
    const std::scoped_lock lock(mutex_);
    events_.add(sample.incarnation(), std::move(*event));
  }
  news_.notify_all();
}

void ClientSession::on_snapshot(const idl::Snapshot& sample) {
  auto snapshot = from_snapshot(sample);
  if (!snapshot) return snapshot_reader_.refuse();
  {
    const std::scoped_lock lock(mutex_);
    if (status_) snapshot->incarnation = status_->incarnation;
    snapshot_ = std::move(snapshot);
    snapshot_is_new_ = true;
  }
  snapshot_news_.notify_all();
}

void ClientSession::on_health(const idl::Health& sample) {
  auto health = from_health(sample);
  if (!health) return health_reader_.refuse();
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
