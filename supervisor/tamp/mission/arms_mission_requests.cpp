// What people ask for, and what becomes of it.

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "runtime/service/answer_codes.h"
#include "supervisor/run/internal/record_json.h"
#include "supervisor/tamp/mission/arms_mission.h"

namespace stepwright::tamp::mission {

using run::IncidentKind;
using run::internal::json;

namespace {

constexpr const char* kExampleOfAGoal =
    R"_(for example {"request": "goal", "goal": "(in cup1 red-region)"})_";

result::Result<ArmsChange> change_of(const run::Request& request) {
  const std::string& word = request.word();
  if (word == "hold") return HoldChange{};
  if (word == "resume") return ResumeChange{};
  const auto text = request.text("goal");
  if (!text) {
    auto none = run::no_request(kExampleOfAGoal);
    return result::forward(none);
  }
  return GoalChange{*text};
}

}  // namespace

std::string ArmsMission::goal_form() const {
  const scene::RobotCell& cell = planning_.cell();
  json things = json::array(), places = json::array(), orders = json::array();
  for (const scene::Thing& each : cell.things) things.push_back(each.name);
  for (const scene::Surface& each : cell.surfaces) places.push_back(each.name);
  for (const scene::Thing& each : cell.things)
    if (each.carries) places.push_back(each.name);
  for (const ArmsOrder& each : planning_.options().orders)
    orders.push_back({{"name", each.name}, {"goal", each.goal}});
  const json in = {
      {"name", "in"},
      {"parameters", {{{"name", "thing"}, {"type", "thing"}}, {{"name", "place"}, {"type", "place"}}}},
      {"changes", true}};
  return run::internal::text_of({{"available", true},
                                 {"domain", "stacking-arms"},
                                 {"metric", ""},
                                 {"objects", {{"thing", std::move(things)}, {"place", std::move(places)}}},
                                 {"predicates", json::array({in})},
                                 {"functions", json::array()},
                                 {"sensors", json::array()},
                                 {"labels", json::object()},
                                 {"orders", std::move(orders)}});
}

result::Result<void> ArmsMission::take(const run::Request& request) {
  const std::string& word = request.word();
  if (word == "start") return request_start(request);
  if (word == "what_if" || word == "cancel_what_if") return request_what_if(request);
  if (word != "hold" && word != "resume" && word != "goal")
    return run::not_of_this_mission("start, goal, what_if, cancel_what_if, hold, resume, abort");
  auto change = change_of(request);
  if (!change) return result::forward(change);
  return over() ? run_is_over() : this->request(*change);
}

// With another order, if one comes with it.
result::Result<void> ArmsMission::request_start(const run::Request& request) {
  const auto order = request.text_or("goal", "");
  if (!order) return run::no_request(kExampleOfAGoal);
  if (!order->empty())
    if (auto good = planning_.order(*order); !good) return result::forward(good);
  return accept_start([&] {
    if (!order->empty()) requests_.add({0.0, GoalChange{*order}});
  });
}

// A question may come before a run and after it, too.
result::Result<void> ArmsMission::request_what_if(const run::Request& request) {
  const auto id = request.text_or("id", "");
  const auto goal = request.text_or("goal", "");
  if (!id || !goal) return run::no_request(kExampleOfAGoal);
  return request.word() == "what_if" ? ask_what_if(*id, *goal) : what_if_.cancel(*id);
}

result::Result<void> ArmsMission::request(const ArmsChange& change) {
  if (const auto* goal = std::get_if<GoalChange>(&change))
    if (auto good = planning_.order(goal->order); !good) return result::forward(good);
  return accept(!std::holds_alternative<GoalChange>(change), [&] { requests_.add({0.0, change}); });
}

std::optional<run::Cause> ArmsMission::due(double time_s) {
  // A program whose schedule nobody knows any more cannot be brought to rest on its paths: it runs to its
  // end.
  if (kind_ == Kind::Follow && reader_ && !driven_ && reading_.stage <= CellStage::Works) return std::nullopt;
  run::Cause cause{IncidentKind::NewGoal, {}};
  bool replans = false;
  for (const TimedArmsRequest& each : requests_.take(time_s))
    replans |= std::visit([&](const auto& change) { return apply(change, cause); }, each.change);
  return decide_request(cause, replans);
}

bool ArmsMission::apply(const GoalChange& goal, run::Cause& cause) {
  auto order = planning_.order(goal.order);
  if (!order) {
    cause.evidence.push_back("refused: " + result::to_string(order.error()));
    return false;
  }
  take_order(*std::move(order));
  tries_.clear();
  cause.evidence.push_back("another order: " + order_.name);
  return true;
}

bool ArmsMission::apply(const HoldChange&, run::Cause& cause) {
  return hold_.want(cause);
}

bool ArmsMission::apply(const ResumeChange&, run::Cause& cause) {
  return hold_.resume(cause, reading_.estop_ok);
}

}  // namespace stepwright::tamp::mission
