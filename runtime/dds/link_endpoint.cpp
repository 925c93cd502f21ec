#include "runtime/dds/link_endpoint.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <mutex>
#include <utility>

#include "runtime/dds/internal/claim.h"
#include "runtime/dds/internal/convert.h"
#include "runtime/dds/internal/namesakes.h"
#include "runtime/dds/internal/participant.h"
#include "runtime/dds/internal/request_queue.h"
#include "runtime/dds/internal/topics.h"
#include "runtime/dds/runtime_client.h"
#include "runtime_typesPubSubTypes.h"

namespace stepwright::dds {
namespace {

using namespace internal;

constexpr std::size_t kMostProcessBytes = 256;

}  // namespace

struct LinkEndpoint::State {
  State(std::unique_ptr<Participant> p, std::string where)
      : participant(std::move(p)),
        wake(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)),
        place(std::move(where)),
        replies(*participant, kReplyTopic, Profile::Queue),
        events(*participant, kEventTopic, Profile::Queue),
        statuses(*participant, kStatusTopic, Profile::Heartbeat),
        snapshots(*participant, kSnapshotTopic, Profile::Picture),
        health(*participant, kHealthTopic, Profile::Picture),
        beacon(*participant, kBeaconTopic, Profile::Picture, Scope::Domain),
        namesakes(*participant),
        presence(
            *participant, kPresenceTopic, Profile::Heartbeat, [this](idl::Presence& sample) { hear(sample); },
            [this](bool) { notify(); }),
        commands(*participant, kCommandTopic, Profile::Queue,
                 [this](idl::Command& sample) { push(from_command(sample), sample.supervisor()); }),
        chunks(*participant, kChunkTopic, Profile::Queue,
               [this](idl::ProgramChunk& sample) { push(from_chunk(sample), sample.supervisor()); }),
        extras(*participant, kExtraTopic, Profile::Queue,
               [this](idl::ExtraCommand& sample) { push(from_extra(sample), sample.supervisor()); }) {}

  ~State() {
    if (wake >= 0) close(wake);
  }

  bool ok() const {
    return wake >= 0 && replies.ok() && events.ok() && statuses.ok() && snapshots.ok() && health.ok() &&
           beacon.ok() && namesakes.ok() && presence.ok() && commands.ok() && chunks.ok() && extras.ok();
  }

  void notify() const {
    const std::uint64_t one = 1;
    // A full counter means that it is readable already.
    [[maybe_unused]] const ssize_t written = ::write(wake, &one, sizeof one);
  }

  void push(std::optional<service::Request> request, bool supervisor) {
    if (!request) return;
    {
      const std::scoped_lock lock(mutex);
      if (supervisor && !claim.admits(request->client, Claim::Clock::now())) {
        if (refused.size() < kMaxQueuedRequests) refused.push_back(held_by_another(*request));
      } else if (!queue.push(std::move(*request))) {
        return;
      }
    }
    notify();
  }

  service::Reply held_by_another(const service::Request& request) const {
    const std::string holder = claim.holder().empty() ? "another supervisor" : claim.holder();
    auto failed =
        result::fail(kHeldByAnother, {}, "the runtime is driven by " + holder + ": nothing was changed",
                     "one supervisor at a time: end that one first");
    service::Reply reply;
    reply.client = request.client;
    reply.id = request.id;
    reply.problems = std::move(failed.value());
    return reply;
  }

  void hear(const idl::Presence& sample) {
    if (sample.process().size() > kMostProcessBytes) return;
    const std::scoped_lock lock(mutex);
    claim.heard(sample.client(), sample.process(), Claim::Clock::now());
  }

  std::unique_ptr<Participant> participant;
  int wake;
  const std::string place;
  std::mutex mutex;
  RequestQueue queue;
  Claim claim;
  std::vector<service::Reply> refused;  // to supervisors that do not hold the runtime, until they are sent
  Writer<idl::ReplyPubSubType> replies;
  Writer<idl::EventPubSubType> events;
  Writer<idl::StatusPubSubType> statuses;
  Writer<idl::SnapshotPubSubType> snapshots;
  Writer<idl::HealthPubSubType> health;
  Writer<idl::BeaconPubSubType> beacon;
  Namesakes namesakes;
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
  auto state = std::make_unique<State>(std::move(*participant), config.place);
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
  std::vector<service::Reply> refused;
  std::optional<service::Request> request;
  {
    const std::scoped_lock lock(state_->mutex);
    refused.swap(state_->refused);
    request = state_->queue.pop();
  }
  for (const service::Reply& reply : refused) publish_reply(reply);
  return request;
}

bool LinkEndpoint::supervisor_alive() const {
  if (!state_->presence.alive()) return false;
  const std::scoped_lock lock(state_->mutex);
  return state_->claim.held(Claim::Clock::now());
}

std::vector<std::string> LinkEndpoint::namesakes() const {
  return state_->namesakes.places(state_->place);
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

void LinkEndpoint::announce() {
  idl::Beacon beacon;
  beacon.runtime_id(state_->participant->runtime_id());
  beacon.place(state_->place);
  state_->beacon.write(beacon);
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
