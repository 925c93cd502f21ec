#include "runtime/dds/link_endpoint.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <mutex>
#include <utility>

#include "runtime/dds/internal/convert.h"
#include "runtime/dds/internal/participant.h"
#include "runtime/dds/internal/request_queue.h"
#include "runtime/dds/internal/topics.h"
#include "runtime_typesPubSubTypes.h"

namespace stepwright::dds {
namespace {

using namespace internal;

}  // namespace

struct LinkEndpoint::State {
  explicit State(std::unique_ptr<Participant> p)
      : participant(std::move(p)),
        wake(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)),
        replies(*participant, kReplyTopic, Profile::Queue),
        events(*participant, kEventTopic, Profile::Queue),
        statuses(*participant, kStatusTopic, Profile::Heartbeat),
        snapshots(*participant, kSnapshotTopic, Profile::Picture),
        health(*participant, kHealthTopic, Profile::Picture),
        presence(
            *participant, kPresenceTopic, Profile::Heartbeat, [](idl::Presence&) {},
            [this](bool) { notify(); }),
        commands(*participant, kCommandTopic, Profile::Queue,
                 [this](idl::Command& sample) { push(from_command(sample)); }),
        chunks(*participant, kChunkTopic, Profile::Queue,
               [this](idl::ProgramChunk& sample) { push(from_chunk(sample)); }),
        extras(*participant, kExtraTopic, Profile::Queue,
               [this](idl::ExtraCommand& sample) { push(from_extra(sample)); }) {}

  ~State() {
    if (wake >= 0) close(wake);
  }

  bool ok() const {
    return wake >= 0 && replies.ok() && events.ok() && statuses.ok() && snapshots.ok() && health.ok() &&
           presence.ok() && commands.ok() && chunks.ok() && extras.ok();
  }

  void notify() const {
    const std::uint64_t one = 1;
    // A full counter means that it is readable already.
    [[maybe_unused]] const ssize_t written = ::write(wake, &one, sizeof one);
  }

  void push(std::optional<service::Request> request) {
    if (!request) return;
    {
      const std::scoped_lock lock(mutex);
      if (!queue.push(std::move(*request))) return;
    }
    notify();
  }

  std::unique_ptr<Participant> participant;
  int wake;
  std::mutex mutex;
  RequestQueue queue;
  Writer<idl::ReplyPubSubType> replies;
  Writer<idl::EventPubSubType> events;
  Writer<idl::StatusPubSubType> statuses;
  Writer<idl::SnapshotPubSubType> snapshots;
  Writer<idl::HealthPubSubType> health;
  // Last, so that they are silent before what their handlers use is gone.
  Reader<idl::PresencePubSubType> presence;
  Reader<idl::CommandPubSubType> commands;
  Reader<idl::ProgramChunkPubSubType> chunks;
  Reader<idl::ExtraCommandPubSubType> extras;
};

LinkEndpoint::LinkEndpoint(std::unique_ptr<State> state) : state_(std::move(state)) {}
LinkEndpoint::~LinkEndpoint() = default;

result::Result<std::unique_ptr<LinkEndpoint>> LinkEndpoint::create(const ParticipantConfig& config) {
  auto participant = Participant::create(config);
  if (!participant) return result::forward(participant);
  auto state = std::make_unique<State>(std::move(*participant));
  if (!state->ok()) return result::fail("D0005", {}, "Fast DDS cannot create the endpoints of the link");
  return std::unique_ptr<LinkEndpoint>(new LinkEndpoint(std::move(state)));
}

int LinkEndpoint::descriptor() const {
  return state_->wake;
}

void LinkEndpoint::clear() {
  std::uint64_t count = 0;
  [[maybe_unused]] const ssize_t taken = ::read(state_->wake, &count, sizeof count);
}

std::optional<service::Request> LinkEndpoint::take_request() {
  const std::scoped_lock lock(state_->mutex);
  return state_->queue.pop();
}

bool LinkEndpoint::supervisor_alive() const {
  return state_->presence.alive();
}

bool LinkEndpoint::publish_event(std::uint64_t incarnation, const StepEvent& event) {
  auto sample = to_event(state_->participant->runtime_id(), incarnation, event);
  return state_->events.write(sample);
}

void LinkEndpoint::publish_reply(const service::Reply& reply) {
  auto sample = to_reply(state_->participant->runtime_id(), reply);
  state_->replies.write(sample);
}

void LinkEndpoint::publish_status(const RuntimeStatus& status, bool runtime_connected) {
  auto sample = to_status(state_->participant->runtime_id(), status, runtime_connected);
  state_->statuses.write(sample);
}

void LinkEndpoint::publish_snapshot(const Snapshot& snapshot) {
  auto sample = to_snapshot(state_->participant->runtime_id(), snapshot);
  state_->snapshots.write(sample);
}

void LinkEndpoint::publish_health(RuntimeHealth health) {
  if (!state_->health.matched()) return;
  health.readers = state_->statuses.readers();
  auto sample = to_health(state_->participant->runtime_id(), health);
  state_->health.write(sample);
}

bool LinkEndpoint::snapshot_wanted() const {
  return state_->snapshots.matched();
}

}  // namespace stepwright::dds
