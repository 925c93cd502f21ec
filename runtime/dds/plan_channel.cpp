#include "runtime/dds/plan_channel.h"

#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <utility>

#include "plan_typesPubSubTypes.h"
#include "runtime/dds/internal/message_endpoints.h"
#include "runtime/dds/internal/random_client.h"
#include "runtime/dds/internal/topics.h"

namespace stepwright::dds {
namespace {

using namespace internal;

// Requests of operators that nobody has taken; a person cannot fill it.
constexpr std::size_t kMaxQueuedPlanRequests = 256;
result::Result<void> check_size(const std::string& text, std::size_t bound, const std::string& what) {
  if (text.size() <= bound) return {};
  return result::fail("D0004", {}, what + " of " + std::to_string(text.size()) + " bytes is too long",
                      "up to " + std::to_string(bound) + " bytes are possible");
}

}  // namespace

struct PlanPublisher::State {
  explicit State(std::unique_ptr<Participant> p)
      : participant(std::move(p)),
        documents(*participant, kDocumentTopic, Profile::Document),
        goal_forms(*participant, kGoalFormTopic, Profile::Document),
        outlooks(*participant, kOutlookTopic, Profile::Document),
        pictures(*participant, kPicturesTopic, Profile::Document),
        answers(*participant, kAnswerTopic, Profile::Queue),
        requests(*participant, kOperatorTopic, Profile::Queue,
                 {.on_message = [this](OperatorRequest request) { on_request(std::move(request)); }}) {}

  void on_request(OperatorRequest request) {
    {
      const std::scoped_lock lock(mutex);
      if (queue.size() >= kMaxQueuedPlanRequests) return;
      queue.push_back(std::move(request));
    }
    arrived.notify_one();
  }

  std::unique_ptr<Participant> participant;
  std::mutex mutex;
  std::condition_variable arrived;
  std::deque<OperatorRequest> queue;
  std::uint64_t revision = 0;
  // A document in place of the one before on its topic.
  result::Result<void> publish(Writer<idl::PlanDocumentPubSubType>& writer, const std::string& json,
                               std::size_t bound, const std::string& what) {
    if (auto fits = check_size(json, bound, what); !fits) return fits;
    idl::PlanDocument sample;
    sample.runtime_id(participant->runtime_id());
    {
      const std::scoped_lock lock(mutex);
      sample.revision(++revision);
    }
    sample.text(json);
    if (!writer.write(sample)) return result::fail("D0010", {}, "viewers do not take " + what);
    return {};
  }

  Writer<idl::PlanDocumentPubSubType> documents;
  Writer<idl::PlanDocumentPubSubType> goal_forms;
  Writer<idl::PlanDocumentPubSubType> outlooks;
  Writer<idl::PlanDocumentPubSubType> pictures;
  MessageWriter<service::OperatorAnswer> answers;
  MessageReader<OperatorRequest> requests;
};

PlanPublisher::PlanPublisher(std::unique_ptr<State> state) : state_(std::move(state)) {}
PlanPublisher::~PlanPublisher() = default;

result::Result<std::unique_ptr<PlanPublisher>> PlanPublisher::create(const ParticipantConfig& config) {
  auto participant = Participant::create(config);
  if (!participant) return result::forward(participant);
  auto state = std::make_unique<State>(std::move(*participant));
  const bool documents =
      state->documents.ok() && state->goal_forms.ok() && state->outlooks.ok() && state->pictures.ok();
  if (!documents || !state->requests.ok() || !state->answers.ok()) {
    return result::fail("D0005", {}, "Fast DDS cannot create the endpoints of the plan channel");
  }
  return std::unique_ptr<PlanPublisher>(new PlanPublisher(std::move(state)));
}

result::Result<void> PlanPublisher::publish(const std::string& json) {
  return state_->publish(state_->documents, json, kMaxPlanDocumentBytes, "a plan document");
}

result::Result<void> PlanPublisher::publish_goal_form(const std::string& json) {
  return state_->publish(state_->goal_forms, json, kMaxGoalDocumentBytes, "a goal form");
}

result::Result<void> PlanPublisher::publish_outlook(const std::string& json) {
  return state_->publish(state_->outlooks, json, kMaxGoalDocumentBytes, "an outlook");
}

result::Result<void> PlanPublisher::publish_pictures(const std::string& json) {
  return state_->publish(state_->pictures, json, kMaxPicturesBytes, "a document of pictures");
}

std::optional<OperatorRequest> PlanPublisher::wait_request(std::chrono::milliseconds timeout) {
  std::unique_lock lock(state_->mutex);
  if (!state_->arrived.wait_for(lock, timeout, [this] { return !state_->queue.empty(); }))
    return std::nullopt;
  OperatorRequest request = std::move(state_->queue.front());
  state_->queue.pop_front();
  return request;
}

result::Result<void> PlanPublisher::answer(const OperatorRequest& request,
                                           const result::Result<void>& verdict) {
  service::OperatorAnswer answer{request.client, request.number, {}};
  if (!verdict) answer.problems = verdict.error();
  // Without any problem it would be accepted.
  if (!verdict && answer.problems.empty())
    answer.problems.push_back({"", result::Severity::Error, {}, "refused", ""});
  if (!state_->answers.write(std::move(answer))) return result::fail("D0010", {}, "nobody takes the answer");
  return {};
}

struct PlanSubscriber::State {
  explicit State(std::unique_ptr<Participant> p)
      : participant(std::move(p)),
        requests(*participant, kOperatorTopic, Profile::Queue),
        answers(*participant, kAnswerTopic, Profile::Queue,
                {.on_message = [this](service::OperatorAnswer answer) { on_answer(std::move(answer)); }}),
        goal_forms(*participant, kGoalFormTopic, Profile::Document,
                   [this](idl::PlanDocument& sample) { keep(sample, goal_form); }),
        outlooks(*participant, kOutlookTopic, Profile::Document,
                 [this](idl::PlanDocument& sample) { keep(sample, outlook); }),
        picture_reader(*participant, kPicturesTopic, Profile::Document,
                       [this](idl::PlanDocument& sample) { keep(sample, pictures, kMaxPicturesBytes); }),
        documents(*participant, kDocumentTopic, Profile::Document,
                  [this](idl::PlanDocument& sample) { on_document(sample); }) {}

  void keep(idl::PlanDocument& sample, std::optional<std::string>& place,
            std::size_t bound = kMaxGoalDocumentBytes) {
    if (sample.text().size() > bound) return;
    const std::scoped_lock lock(mutex);
    place = std::move(sample.text());
  }

  void on_document(idl::PlanDocument& sample) {
    if (sample.text().size() > kMaxPlanDocumentBytes) return;
    {
      const std::scoped_lock lock(mutex);
      newest = std::move(sample.text());
      ++arrivals;
    }
    arrived.notify_all();
  }

  void on_answer(service::OperatorAnswer answer) {
    if (answer.client != client) return;
    {
      const std::scoped_lock lock(mutex);
      const auto asked = open.find(answer.number);
      if (asked == open.end()) return;
      asked->second = std::move(answer.problems);
    }
    arrived.notify_all();
  }

  std::unique_ptr<Participant> participant;
  const std::uint64_t client = random_client();
  std::mutex mutex;
  std::condition_variable arrived;
  std::optional<std::string> newest;
  std::optional<std::string> goal_form;
  std::optional<std::string> outlook;
  std::optional<std::string> pictures;
  std::uint64_t arrivals = 0;
  std::uint64_t waited_for = 0;  // arrivals when wait_newer returned last
  std::uint64_t last_request = 0;
  // Requests that somebody waits for, and their answers.
  std::map<std::uint64_t, std::optional<result::Diagnostics>> open;
  MessageWriter<OperatorRequest> requests;
  MessageReader<service::OperatorAnswer> answers;
  Reader<idl::PlanDocumentPubSubType> goal_forms;
  Reader<idl::PlanDocumentPubSubType> outlooks;
  Reader<idl::PlanDocumentPubSubType> picture_reader;
  Reader<idl::PlanDocumentPubSubType> documents;
};

PlanSubscriber::PlanSubscriber(std::unique_ptr<State> state) : state_(std::move(state)) {}
PlanSubscriber::~PlanSubscriber() = default;

result::Result<std::unique_ptr<PlanSubscriber>> PlanSubscriber::create(const ParticipantConfig& config) {
  auto participant = Participant::create(config);
  if (!participant) return result::forward(participant);
  auto state = std::make_unique<State>(std::move(*participant));
  const bool documents =
      state->documents.ok() && state->goal_forms.ok() && state->outlooks.ok() && state->picture_reader.ok();
  if (!documents || !state->requests.ok() || !state->answers.ok()) {
    return result::fail("D0005", {}, "Fast DDS cannot create the endpoints of the plan channel");
  }
  return std::unique_ptr<PlanSubscriber>(new PlanSubscriber(std::move(state)));
}

std::optional<std::string> PlanSubscriber::latest() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->newest;
}

std::optional<std::string> PlanSubscriber::goal_form() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->goal_form;
}

std::optional<std::string> PlanSubscriber::outlook() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->outlook;
}

std::optional<std::string> PlanSubscriber::pictures() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->pictures;
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

result::Result<void> PlanSubscriber::request(const std::string& json, std::chrono::milliseconds timeout) {
  if (auto fits = check_size(json, kMaxOperatorRequestBytes, "a request"); !fits) return fits;
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  // An answer to somebody who is not yet known to the supervisor would be lost.
  if (!state_->requests.matched() || !state_->answers.matched()) {
    return result::fail(service::kNobodyAnswers, {}, "no supervisor takes requests",
                        "is the supervisor of the cell running?");
  }
  std::unique_lock lock(state_->mutex);
  const std::uint64_t number = ++state_->last_request;
  state_->open.emplace(number, std::nullopt);
  lock.unlock();
  const bool taken = state_->requests.write({json, state_->client, number});
  lock.lock();
  if (taken) state_->arrived.wait_until(lock, deadline, [&] { return state_->open.at(number).has_value(); });
  const std::optional<result::Diagnostics> answer = std::move(state_->open.extract(number).mapped());
  if (!taken) return result::fail(service::kNobodyAnswers, {}, "the supervisor does not take the request");
  if (!answer) {
    return result::fail(service::kNotAnsweredYet, {}, "the supervisor has the request and has not answered",
                        "it may obey all the same: look at what it does");
  }
  if (!answer->empty()) return tl::unexpected(*answer);
  return {};
}

}  // namespace stepwright::dds
