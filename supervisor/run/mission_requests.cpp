// What people ask of a run, and a plan that waits for whoever starts it.

#include <utility>

#include "runtime/service/answer_codes.h"
#include "supervisor/run/internal/record_json.h"
#include "supervisor/run/mission.h"

namespace stepwright::run {
namespace {

constexpr std::chrono::milliseconds kLookAtRequests{50};

}  // namespace

result::Result<void> Mission::obey(const Request& request) {
  if (request.word() != "abort") return take(request);
  if (over()) return run_is_over();
  request_abort();
  return {};
}

result::Result<void> Mission::take(const Request& request) {
  return request.word() == "start" ? accept_start() : not_of_this_mission("start, abort");
}

result::Result<void> Mission::run_is_over() const {
  return result::fail(service::kNotNow, {}, "the run is over",
                      can_begin_again() ? "start another one" : "start the supervisor again for another one");
}

std::string Mission::goal_form() const {
  return no_goal_form_json("this planner has no goals that a page could put together");
}

std::string no_goal_form_json(const std::string& reason, const std::vector<std::string>& locations) {
  nlohmann::json form = {{"available", false}, {"reason", reason}};
  if (!locations.empty()) form["locations"] = locations;
  return internal::text_of(form);
}

void Mission::enter(Stage stage) {
  const std::lock_guard lock(requests_mutex_);
  if (stage_ == stage) return;
  stage_ = stage;
  if (stage != Stage::Running) start_ = false;
}

bool Mission::is(Stage stage) const {
  const std::lock_guard lock(requests_mutex_);
  return stage_ == stage;
}

bool Mission::over() const {
  return is(Stage::Over);
}

bool Mission::start_wanted() const {
  const std::lock_guard lock(requests_mutex_);
  return start_;
}

void Mission::begin_start() {
  const std::lock_guard lock(requests_mutex_);
  stage_ = Stage::Running;
  start_ = false;
}

void Mission::forget_start() {
  const std::lock_guard lock(requests_mutex_);
  start_ = false;
}

bool Mission::wait_start(std::chrono::milliseconds timeout) {
  std::unique_lock lock(requests_mutex_);
  return start_signal_.wait_for(lock, timeout, [this] { return start_; });
}

result::Result<void> Mission::accept_start(const std::function<void()>& also) {
  const auto refuse = [](const char* why, const char* hint) {
    return result::fail(service::kNotNow, {}, why, hint);
  };
  if (!controller_.alive())
    return refuse("no runtime answers: the plant would begin to move whenever one comes",
                  "start the runtime first");
  const std::lock_guard lock(requests_mutex_);
  if (stage_ == Stage::Planless)
    return refuse("there is no plan to start", "take an order back or free a place: the message says why");
  const bool waits = stage_ == Stage::Ready || (stage_ == Stage::Over && can_begin_again());
  if (stage_ == Stage::Over && !waits) return run_is_over();
  if (!waits || start_)
    return refuse("the run is under way", "hold or abort it, or hand over what else is wanted");
  if (stage_ == Stage::Ready && abort_) return refuse("the run is being aborted", "start again in a moment");
  if (stage_ == Stage::Over) {
    abort_ = false;
    forget_requests();
    stage_ = Stage::Running;
  }
  if (also) also();
  start_ = true;
  start_signal_.notify_all();
  return {};
}

bool Mission::await_operator(const std::string& message) {
  if (!options_.operator_starts) return true;
  std::optional<Cause> cause;
  while (!start_wanted()) {  // another run has been started already
    if (await_wish(Stage::Ready, message, cause) == Wish::Abort) return false;
  }
  begin_start();
  return true;
}

Mission::Wish Mission::await_wish(Stage stage, std::string message, std::optional<Cause>& cause) {
  enter(stage);
  set_phase(Phase::Ready, std::move(message));
  while (true) {
    if (abort_) {
      give_up_aborted();
      return Wish::Abort;
    }
    const bool started = wait_start(kLookAtRequests);
    cause = due(clock_.now_s());
    if (cause) return Wish::OtherPlan;
    if (started) return Wish::Start;
    publish(/*now=*/false);
  }
}

}  // namespace stepwright::run
