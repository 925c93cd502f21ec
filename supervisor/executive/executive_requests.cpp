// What people ask of a run of a task plan: at once what can be told of it, the rest at the next decision.

#include "runtime/service/answer_codes.h"
#include "supervisor/executive/executive.h"
#include "supervisor/pddl/plan/describe_run.h"

namespace stepwright::executive {
namespace {

constexpr const char* kExample =
    R"_(for example {"request": "change", "fluent": "(demand c1)", "value": 8})_";

}  // namespace

// A question, or another run, may come when a run is over; all else is for the run.
result::Result<void> Executive::take(const run::Request& request) {
  const std::string& word = request.word();
  const auto goal = request.text_or("goal", "");
  if (word == "start") return goal ? request_start(*goal) : run::no_request(kExample);
  const auto id = request.text_or("id", "");
  if (word == "what_if")
    return goal && id ? what_if_.ask({*id, *goal, outlook()}) : run::no_request(kExample);
  if (word == "cancel_what_if") return id ? what_if_.cancel(*id) : run::no_request(kExample);
  const auto fluent = request.text("fluent");
  const auto value = request.number("value");
  if (word == "change" && !(fluent && value)) return run::no_request(kExample);
  if (word == "goal" && !request.text("goal")) return run::no_request(kExample);
  if (word != "hold" && word != "resume" && word != "goal" && word != "change")
    return run::not_of_this_mission("start, hold, resume, change, goal, what_if, cancel_what_if, abort");
  if (over()) return run_is_over();
  if (word == "hold") return request_hold();
  if (word == "resume") return request_resume();
  return word == "goal" ? request_goal(*goal) : request_change(*fluent, *value);
}

void Executive::forget_requests() {
  hold_ = false;
  requests_.forget_asked();
}

result::Result<void> Executive::request_start(const std::string& goal) {
  if (!goal.empty()) {
    if (auto checked = planning_.check_goal(goal); !checked) return checked;
  }
  return accept_start([&] {
    if (!goal.empty()) requests_.add({0.0, {}, 0.0, goal});
  });
}

result::Result<void> Executive::request_hold() {
  {
    const std::lock_guard lock(requests_mutex_);
    if (stage_ == Stage::Ready && !start_)
      return result::fail(service::kNotNow, {}, "nothing runs yet that could be held",
                          "it waits for its start");
  }
  if (!hold_.exchange(true)) return {};
  return result::fail(service::kNotNow, {}, "the run is held already", "resume or abort it");
}

result::Result<void> Executive::request_resume() {
  if (hold_.exchange(false)) return {};
  return result::fail(service::kNotNow, {}, "nothing is held that could be resumed");
}

result::Result<void> Executive::request_change(const std::string& fluent, double value) {
  const std::string name = pddl::canonical_name(fluent);
  if (!planning_.task().initial().value(name)) {
    return result::fail("X0003", {}, "there is no fluent " + name,
                        "name it as in the problem, e.g. (demand c1)");
  }
  if (planning_.binding().sensor_of(name) != nullptr) {
    return result::fail("X0003", {}, name + " is measured; nobody can set it",
                        "change a demand or a goal instead");
  }
  requests_.add({0.0, name, value});
  return {};
}

result::Result<void> Executive::request_goal(const std::string& goal) {
  if (auto checked = planning_.check_goal(goal); !checked) return checked;
  requests_.add({0.0, {}, 0.0, goal});
  return {};
}

std::string Executive::goal_form() const {
  return goal_form_json(planning_);
}

std::optional<std::string> Executive::new_outlook() {
  const std::pair now{outlook_revision(), what_if_.revision()};
  if (told_ == now) return std::nullopt;
  told_ = now;
  return outlook_writer_.json(outlook(), what_if_.answer());
}

}  // namespace stepwright::executive
