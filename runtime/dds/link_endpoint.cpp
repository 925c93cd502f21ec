#include "runtime/dds/link_endpoint.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <mutex>
#include <span>
#include <utility>

#include "runtime/dds/internal/claim.h"
#include "runtime/dds/internal/message_endpoints.h"
#include "runtime/dds/internal/namesakes.h"
#include "runtime/dds/internal/request_queue.h"
#include "runtime/dds/internal/socket_only.h"
#include "runtime/dds/internal/topics.h"
#include "runtime/dds/runtime_client.h"

namespace stepwright::dds {
namespace {

using namespace internal;

service::Reply refusal_of(const service::Request& request, result::Diagnostics problems) {
  service::Reply reply;
  reply.client = request.client;
  reply.id = request.id;
  reply.problems = std::move(problems);
  return reply;
}

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
        presence(*participant, kPresenceTopic, Profile::Heartbeat,
                 {.on_message = [this](const service::Presence& who) { hear(who); },
                  .on_alive = [this](bool) { notify(); }}),
        requests(*participant, kRequestTopic, Profile::Queue,
                 {.on_bytes = [this](const service::Request& request, std::span<const std::byte> bytes) {
                   push(request, bytes);
                 }}) {}

  ~State() {
    if (wake >= 0) close(wake);
  }

  bool ok() const {
    return wake >= 0 && replies.ok() && events.ok() && statuses.ok() && snapshots.ok() && health.ok() &&
           beacon.ok() && namesakes.ok() && presence.ok() && requests.ok();
  }

  void notify() const {
    const std::uint64_t one = 1;
    // A full counter means that it is readable already.
    [[maybe_unused]] const ssize_t written = ::write(wake, &one, sizeof one);
  }

  void push(const service::Request& request, std::span<const std::byte> bytes) {
    {
      const std::scoped_lock lock(mutex);
      if (auto admitted = admit(request); !admitted) {
        if (refused.size() < kMaxQueuedRequests)
          refused.push_back(refusal_of(request, std::move(admitted.error())));
      } else if (!queue.push(request.body, bytes)) {
        return;
      }
    }
    notify();
  }

  result::Result<void> admit(const service::Request& request) {
    if (service::is_for_the_socket_only(request.body)) return ask_on_the_socket();
    if (!request.supervisor || claim.admits(request.client, Claim::Clock::now())) return {};
    const std::string holder = claim.holder().empty() ? "another supervisor" : claim.holder();
    return result::fail(kHeldByAnother, {}, "the runtime is driven by " + holder + ": nothing was changed",
                        "one supervisor at a time: end that one first");
  }

  void hear(const service::Presence& who) {
    const std::scoped_lock lock(mutex);
    claim.heard(who.client, who.process, Claim::Clock::now());
  }

  std::unique_ptr<Participant> participant;
  int wake;
  const std::string place;
  std::mutex mutex;
  RequestQueue queue;
  Claim claim;
  std::vector<service::Reply> refused;  // answers to what is refused here, until they are sent
  MessageWriter<service::Reply> replies;
  MessageWriter<StepEvent> events;
  MessageWriter<service::LinkStatus> statuses;
  MessageWriter<Snapshot> snapshots;
  MessageWriter<RuntimeHealth> health;
  MessageWriter<service::Beacon> beacon;
  Namesakes namesakes;
  // Last, so that they are silent before what their handlers use is gone.
  MessageReader<service::Presence> presence;
  MessageReader<service::Request> requests;
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

std::optional<std::vector<std::byte>> LinkEndpoint::take_request() {
  std::vector<service::Reply> refused;
  std::optional<std::vector<std::byte>> request;
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

bool LinkEndpoint::publish_event(const StepEvent& event) {
  return state_->events.write(event);
}

void LinkEndpoint::publish_reply(const service::Reply& reply) {
  state_->replies.write(reply);
}

// The details of the tasks travel with the health.
void LinkEndpoint::publish_status(RuntimeStatus status, bool runtime_connected) {
  status.task_details.clear();
  state_->statuses.write({std::move(status), runtime_connected});
}

void LinkEndpoint::publish_snapshot(Snapshot snapshot) {
  state_->snapshots.write(std::move(snapshot));
}

void LinkEndpoint::announce() {
  state_->beacon.write({state_->participant->runtime_id(), state_->place});
}

void LinkEndpoint::publish_health(RuntimeHealth health) {
  if (!state_->health.matched()) return;
  health.readers = state_->statuses.readers();
  state_->health.write(std::move(health));
}

bool LinkEndpoint::snapshot_wanted() const {
  return state_->snapshots.matched();
}

}  // namespace stepwright::dds
