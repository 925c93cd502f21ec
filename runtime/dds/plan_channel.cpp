#include "runtime/dds/plan_channel.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <utility>

#include "plan_typesPubSubTypes.h"
#include "runtime/dds/internal/participant.h"
#include "runtime/dds/internal/topics.h"

namespace stepwright::dds {
namespace {

using namespace internal;

// Requests of operators that nobody has taken; a person cannot fill it.
constexpr std::size_t kMaxQueuedRequests = 256;

result::Result<void> check_size(const std::string& text, std::size_t bound, const char* what) {
  if (text.size() <= bound) return {};
  return result::fail("D0004", {},
                      std::string(what) + " of " + std::to_string(text.size()) + " bytes is too long",
                      "up to " + std::to_string(bound) + " bytes are possible");
}

}  // namespace

struct PlanPublisher::State {
  explicit State(std::unique_ptr<Participant> p)
      : participant(std::move(p)),
        documents(*participant, kDocumentTopic, Profile::Document),
        requests(*participant, kOperatorTopic, Profile::Queue,
                 [this](idl::OperatorRequest& sample) { on_request(sample); }) {}

  void on_request(idl::OperatorRequest& sample) {
    if (sample.text().size() > kMaxOperatorRequestBytes) return;
    {
      const std::scoped_lock lock(mutex);
      if (queue.size() >= kMaxQueuedRequests) return;
      queue.push_back(std::move(sample.text()));
    }
    arrived.notify_one();
  }

  std::unique_ptr<Participant> participant;
  std::mutex mutex;
  std::condition_variable arrived;
  std::deque<std::string> queue;
  std::uint64_t revision = 0;
  Writer<idl::PlanDocumentPubSubType> documents;
  Reader<idl::OperatorRequestPubSubType> requests;
};

PlanPublisher::PlanPublisher(std::unique_ptr<State> state) : state_(std::move(state)) {}
PlanPublisher::~PlanPublisher() = default;

result::Result<std::unique_ptr<PlanPublisher>> PlanPublisher::create(const ParticipantConfig& config) {
  auto participant = Participant::create(config);
  if (!participant) return result::forward(participant);
  auto state = std::make_unique<State>(std::move(*participant));
  if (!state->documents.ok() || !state->requests.ok()) {
    return result::fail("D0005", {}, "Fast DDS cannot create the endpoints of the plan channel");
  }
  return std::unique_ptr<PlanPublisher>(new PlanPublisher(std::move(state)));
}

result::Result<void> PlanPublisher::publish(const std::string& json) {
  if (auto fits = check_size(json, kMaxPlanDocumentBytes, "a plan document"); !fits) return fits;
  idl::PlanDocument sample;
  sample.runtime_id(state_->participant->runtime_id());
  {
    const std::scoped_lock lock(state_->mutex);
    sample.revision(++state_->revision);
  }
  sample.text(json);
  if (!state_->documents.write(sample))
    return result::fail("D0001", {}, "viewers do not take the plan document");
  return {};
}

std::optional<std::string> PlanPublisher::wait_request(std::chrono::milliseconds timeout) {
  std::unique_lock lock(state_->mutex);
  if (!state_->arrived.wait_for(lock, timeout, [this] { return !state_->queue.empty(); }))
    return std::nullopt;
  std::string text = std::move(state_->queue.front());
  state_->queue.pop_front();
  return text;
}

struct PlanSubscriber::State {
  explicit State(std::unique_ptr<Participant> p)
      : participant(std::move(p)),
        requests(*participant, kOperatorTopic, Profile::Queue),
        documents(*participant, kDocumentTopic, Profile::Document,
                  [this](idl::PlanDocument& sample) { on_document(sample); }) {}

  void on_document(idl::PlanDocument& sample) {
    if (sample.text().size() > kMaxPlanDocumentBytes) return;
    {
      const std::scoped_lock lock(mutex);
      newest = std::move(sample.text());
      ++arrivals;
    }
    arrived.notify_all();
  }

  std::unique_ptr<Participant> participant;
  std::mutex mutex;
  std::condition_variable arrived;
  std::optional<std::string> newest;
  std::uint64_t arrivals = 0;
  std::uint64_t waited_for = 0;  // arrivals when wait_newer returned last
  std::uint64_t last_request = 0;
  Writer<idl::OperatorRequestPubSubType> requests;
  Reader<idl::PlanDocumentPubSubType> documents;
};

PlanSubscriber::PlanSubscriber(std::unique_ptr<State> state) : state_(std::move(state)) {}
PlanSubscriber::~PlanSubscriber() = default;

result::Result<std::unique_ptr<PlanSubscriber>> PlanSubscriber::create(const ParticipantConfig& config) {
  auto participant = Participant::create(config);
  if (!participant) return result::forward(participant);
  auto state = std::make_unique<State>(std::move(*participant));
  if (!state->documents.ok() || !state->requests.ok()) {
    return result::fail("D0005", {}, "Fast DDS cannot create the endpoints of the plan channel");
  }
  return std::unique_ptr<PlanSubscriber>(new PlanSubscriber(std::move(state)));
}

std::optional<std::string> PlanSubscriber::latest() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->newest;
}

std::optional<std::string> PlanSubscriber::wait_newer(std::chrono::milliseconds timeout) {
  std::unique_lock lock(state_->mutex);
  const auto newer = [this] { return state_->arrivals > state_->waited_for; };
  if (!state_->arrived.wait_for(lock, timeout, newer)) return std::nullopt;
  state_->waited_for = state_->arrivals;
  return state_->newest;
}

bool PlanSubscriber::supervisor_alive() const {
  return state_->documents.matched();
}

result::Result<void> PlanSubscriber::request(const std::string& json) {
  if (auto fits = check_size(json, kMaxOperatorRequestBytes, "a request"); !fits) return fits;
  if (!state_->requests.matched()) {
    return result::fail("D0001", {}, "no supervisor takes requests",
                        "is the supervisor of the cell running?");
  }
  idl::OperatorRequest sample;
  sample.runtime_id(state_->participant->runtime_id());
  {
    const std::scoped_lock lock(state_->mutex);
    sample.request(++state_->last_request);
  }
  sample.text(json);
  if (!state_->requests.write(sample))
    return result::fail("D0001", {}, "the supervisor does not take the request");
  return {};
}

}  // namespace stepwright::dds
