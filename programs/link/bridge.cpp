#include "programs/link/bridge.h"

#include <poll.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace stepwright::link {
namespace {

using namespace std::chrono_literals;

constexpr auto kTurn = 20ms;            // of the loop, when nothing happens
constexpr auto kAlivePeriod = 50ms;     // of the signs of life in both directions
constexpr auto kSnapshotPeriod = 30ms;  // of the image on Fast DDS: often enough for an eye
constexpr auto kHealthPeriod = 1s;
constexpr auto kConnectPeriod = 50ms;
const std::string kNamesake = "another runtime of this name is in the domain, at ";
// The service sends its status every 100 ms: a runtime that is silent for so long hangs.
constexpr auto kSilence = 600ms;

}  // namespace

void Bridge::turn(int stop_descriptor) {
  if (!connection_ && Clock::now() >= connect_at_) connect();
  std::array<pollfd, 3> entries{
      {{stop_descriptor, POLLIN, 0}, {endpoint_->descriptor(), POLLIN, 0}, {-1, POLLIN, 0}}};
  if (connection_) entries[2].fd = connection_->descriptor();
  poll(entries.data(), entries.size(), static_cast<int>(pause().count()));
  pass_requests();
  pass_messages();
  keep_alive();
  publish_snapshot();
  publish_health();
}

// Until the next image is due, if anybody wants one.
std::chrono::milliseconds Bridge::pause() const {
  if (!connection_ || !endpoint_->snapshot_wanted()) return kTurn;
  const auto left =
      std::chrono::ceil<std::chrono::milliseconds>(snapshot_at_ + kSnapshotPeriod - Clock::now());
  return std::clamp<std::chrono::milliseconds>(left, 0ms, kTurn);
}

void Bridge::connect() {
  connect_at_ = Clock::now() + kConnectPeriod;
  auto connection = service::Connection::open(socket_, {service::Role::Controller, "link", 0});
  if (!connection) return;
  connection_ = std::move(*connection);
  heard_ = {};  // until this runtime's own status is here
  log_.info("connected", "connected to " + socket_.string(), {{"socket", socket_.string()}});
}

// Without a runtime requests are dropped: their senders repeat them.
void Bridge::pass_requests() {
  endpoint_->clear();
  while (auto request = endpoint_->take_request()) {
    if (connection_) connection_->pass_on(*request);
  }
}

void Bridge::pass_messages() {
  if (!connection_) return;
  while (auto message = connection_->receive(0ms)) pass(*message);
  if (!connection_->closed()) return;
  connection_.reset();
  log_.warning("gone", "the runtime at " + socket_.string() + " is gone", {{"socket", socket_.string()}});
}

void Bridge::pass(const service::Message& message) {
  if (const auto* reply = std::get_if<service::Reply>(&message)) {
    endpoint_->publish_reply(*reply);
  } else if (const auto* event = std::get_if<host::StepEvent>(&message)) {
    endpoint_->publish_event(*event);
  } else if (const auto* status = std::get_if<host::RuntimeStatus>(&message)) {
    status_ = *status;
    heard_ = Clock::now();
    publish_status();
  }
}

bool Bridge::runtime_answers() const {
  return connection_ && Clock::now() - heard_ <= kSilence;
}

void Bridge::keep_alive() {
  const bool supervised = endpoint_->supervisor_alive();
  const bool changed = supervised != was_supervised_ || (was_answering_ && !runtime_answers());
  if (!changed && Clock::now() - alive_at_ < kAlivePeriod) return;
  alive_at_ = Clock::now();
  was_supervised_ = supervised;
  publish_status();
  if (connection_) connection_->send(service::SupervisorLife{supervised});
}

// Each is also the link's heartbeat.
void Bridge::publish_status() {
  was_answering_ = runtime_answers();
  if (namesakes_.empty()) return endpoint_->publish_status(status_, was_answering_);
  host::RuntimeStatus told = status_;
  told.detail += (told.detail.empty() ? "" : "; ") + kNamesake + namesakes_.front();
  ++told.process.warnings;
  endpoint_->publish_status(told, was_answering_);
}

void Bridge::publish_snapshot() {
  if (!connection_ || Clock::now() - snapshot_at_ < kSnapshotPeriod || !endpoint_->snapshot_wanted()) return;
  if (heard_ == Clock::time_point{}) return;  // nothing says yet of which process it would be
  snapshot_at_ = Clock::now();
  // Repeated even when nothing moved: samples are best effort, and a viewer may just have come.
  auto snapshot = connection_->snapshot();
  if (!snapshot) return;
  snapshot->incarnation = status_.incarnation;
  endpoint_->publish_snapshot(std::move(*snapshot));
}

// Also without a runtime: its I/O may be there.
void Bridge::publish_health() {
  if (Clock::now() - health_at_ < kHealthPeriod) return;
  health_at_ = Clock::now();
  dds::RuntimeHealth health;
  health.tasks = status_.task_details;
  devices_.fill(health);
  endpoint_->publish_health(std::move(health));
  endpoint_->announce();
  look_for_namesakes();
}

// They do no harm, as nobody of theirs meets anybody of ours; but people mix them up.
void Bridge::look_for_namesakes() {
  auto places = endpoint_->namesakes();
  if (places == namesakes_) return;
  for (const std::string& place : places) {
    if (std::find(namesakes_.begin(), namesakes_.end(), place) == namesakes_.end())
      log_.warning("namesake", kNamesake + place, {{"place", place}});
  }
  namesakes_ = std::move(places);
}

}  // namespace stepwright::link
