#include "tests/browser/bench_script.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/browser/bench_actions.h"

namespace stepwright::browser {
namespace {

constexpr double kReplannedS = 36.2;
constexpr double kForever = std::numeric_limits<double>::infinity();

// How much of the action is done at `time_s`, 0 to 1.
double share(const ScriptedAction& action, double time_s) {
  return std::clamp((time_s - action.start_s) / (action.finish_s - action.start_s), 0.0, 1.0);
}

bool runs(const ScriptedAction& action, double time_s) {
  return time_s >= action.start_s && time_s < action.finish_s;
}

void apply(const ScriptedAction& action, double time_s, BenchInstant& bench) {
  const double moved = share(action, time_s) * action.percent;
  double& tank = action.place < 0 ? bench.level_a1 : bench.level_a2;
  switch (action.effect) {
    case Effect::Load:
      bench.level_v1 += moved;
      bench.pump_b1 |= runs(action, time_s);
      return;
    case Effect::Unload:
      bench.level_v1 -= moved;
      tank += moved;
      bench.pump_b2 |= runs(action, time_s);
      return;
    case Effect::Order:
      tank -= moved;
      (action.place < 0 ? bench.pump_b3 : bench.pump_b4) |= runs(action, time_s);
      return;
    case Effect::Move: {
      const double from = bench.vehicle_position;
      bench.vehicle_position += share(action, time_s) * (action.place - from);
      (action.place < from ? bench.left : bench.right) |= runs(action, time_s);
      return;
    }
  }
}

std::string state_of(const ScriptedAction& action, double time_s) {
  return time_s < action.start_s ? "pending" : time_s < action.finish_s ? "active" : "done";
}

nlohmann::json known_from(double moment, double time_s) {
  return time_s >= moment ? nlohmann::json(moment) : nlohmann::json(nullptr);
}

nlohmann::json levels_of(const BenchInstant& bench) {
  return {{"(lev v1)", bench.level_v1 / 10},
          {"(level a1)", bench.level_a1 / 10},
          {"(level a2)", bench.level_a2 / 10}};
}

// What the supervisor decided about the level that called for another plan.
nlohmann::json incidents_until(double time_s) {
  using nlohmann::json;
  json incidents = json::array();
  if (time_s <= kReplannedS) return incidents;
  const json alarm = {{"action", "(complete_order a1 c1 level7)"},
                      {"kind", "effect"},
                      {"condition", "level of a1 within 0.2 of 3"},
                      {"scan", 3621},
                      {"value", 2.7},
                      {"sensor", "S2"}};
  incidents.push_back({{"time_s", kReplannedS},
                       {"kind", "level"},
                       {"action", "(complete_order a1 c1 level7)"},
                       {"evidence", json::array({"level of a1 is 2.7, expected 3.0 (tolerance 0.2)"})},
                       {"alarms", json::array({alarm})},
                       {"decision", "replan"},
                       {"decision_ms", 4.2},
                       {"repair_ms", 1.1},
                       {"replan_ms", 3.9},
                       {"kept", 7},
                       {"remaining", 9},
                       {"restarts", 0}});
  return incidents;
}

// After that many actions, one after the other.
nlohmann::json levels_after(std::size_t count) {
  BenchInstant bench;
  for (std::size_t i = 0; i < count; ++i) apply(scripted_actions()[i], kForever, bench);
  return levels_of(bench);
}

}  // namespace

BenchScript::BenchScript() {
  add_steps_and_transitions();
  program_.digest = "5f0c9a1e77d24b60";
}

double BenchScript::end_s() const {
  return scripted_actions().back().finish_s;
}

// A step for each action and the waiting step between two that belong to a divergence or a convergence.
void BenchScript::add_steps_and_transitions() {
  const auto& actions = scripted_actions();
  program_.steps.push_back({"START", "", true});
  active_.emplace_back(-kForever, actions.front().start_s);
  for (const auto& action : actions) {
    program_.steps.push_back({std::string(action.step), std::string(action.text), false});
    active_.emplace_back(action.start_s, action.finish_s);
  }
  std::vector<std::vector<std::uint32_t>> inputs(actions.size());
  std::vector<std::vector<int>> successors(actions.size());
  for (std::size_t i = 0; i < actions.size(); ++i) {
    for (const int before : actions[i].after)
      successors[static_cast<std::size_t>(before)].push_back(static_cast<int>(i));
  }
  program_.transitions.push_back({"T00", {0}, {1}, "fc1"});
  for (std::size_t i = 0; i < actions.size(); ++i) {
    protocol::ProgramTransition done{
        "T_" + std::string(actions[i].step), {static_cast<std::uint32_t>(i + 1)}, {}, {}};
    done.condition = actions[i].effect == Effect::Move ? (actions[i].place < 0   ? "fc2"
                                                          : actions[i].place > 0 ? "fc3"
                                                                                 : "fc1")
                                                       : "S1_FILTERED >= V1_TARGET_" + std::to_string(i);
    for (const int next : successors[i]) {
      const auto target = static_cast<std::size_t>(next);
      if (successors[i].size() == 1 && actions[target].after.size() == 1) {
        done.targets.push_back(static_cast<std::uint32_t>(target + 1));
        continue;
      }
      const auto wait = static_cast<std::uint32_t>(program_.steps.size());
      program_.steps.push_back({"W" + std::to_string(i + 1) + "_" + std::to_string(target + 1), "", false});
      active_.emplace_back(actions[i].finish_s, actions[target].start_s + 0.2);
      done.targets.push_back(wait);
      inputs[target].push_back(wait);
    }
    if (done.targets.empty()) {
      done.targets.push_back(static_cast<std::uint32_t>(program_.steps.size()));
      program_.steps.push_back({"DONE_" + std::to_string(i + 1), "", false});
      active_.emplace_back(actions[i].finish_s, kForever);
    }
    program_.transitions.push_back(std::move(done));
  }
  for (std::size_t i = 0; i < actions.size(); ++i) {
    if (inputs[i].empty()) continue;
    program_.transitions.push_back(
        {"T_START_" + std::to_string(i + 1), inputs[i], {static_cast<std::uint32_t>(i + 1)}, "TRUE"});
  }
  // Where the third action would end if it could not go on.
  program_.transitions.push_back(
      {"X_S03_UNLOAD", {3}, {static_cast<std::uint32_t>(program_.steps.size())}, "NOT fc2"});
  program_.steps.push_back({"FAILED_S03_UNLOAD", "not possible: (unload v1 a1 level8)", false});
  active_.emplace_back(kForever, kForever);
}

BenchInstant BenchScript::at(double time_s) const {
  BenchInstant bench;
  for (const auto& action : scripted_actions()) apply(action, time_s, bench);
  for (const auto& [from, to] : active_) bench.steps.push_back(time_s >= from && time_s < to);
  return bench;
}

std::string BenchScript::plan_document(double time_s) const {
  using nlohmann::json;
  const auto& scripted = scripted_actions();
  json actions = json::array();
  for (std::size_t i = 0; i < scripted.size(); ++i) {
    const auto& action = scripted[i];
    actions.push_back({{"index", i},
                       {"text", action.text},
                       {"step", action.step},
                       {"state", state_of(action, time_s)},
                       {"started_s", known_from(action.start_s, time_s)},
                       {"finished_s", known_from(action.finish_s, time_s)},
                       {"planned_start_s", action.planned_start_s},
                       {"planned_finish_s", action.planned_finish_s},
                       {"expected", levels_after(i + 1)}});
  }
  // Both are of the newest completion: that is when the supervisor compares.
  double compared_s = 0;
  for (const auto& action : scripted) {
    if (action.finish_s <= time_s) compared_s = std::max(compared_s, action.finish_s);
  }
  const BenchInstant now = at(compared_s);
  json replans = json::array();
  if (time_s > kReplannedS) {
    replans.push_back({{"time_s", kReplannedS},
                       {"cause", "level of a1 is 2.7, expected 3.0 (tolerance 0.2)"},
                       {"after_action", "(complete_order a1 c1 level7)"}});
  }
  const bool over = time_s >= end_s();
  const json document = {
      {"cell", "bench"},
      {"phase", over ? "done" : "executing"},
      {"message", over ? "The goal is reached." : "Executing the plan; all levels are as expected."},
      {"program_digest", program_.digest},
      {"plan",
       {{"cost", 108},
        {"bound", 108},
        {"proved_optimal", true},
        {"steps", scripted.size()},
        {"first_plan_ms", 1.24},
        {"optimal_plan_ms", 30.1}}},
      {"actions", actions},
      {"replans", replans},
      {"incidents", incidents_until(time_s)},
      {"expected", levels_of(now)},
      {"observed",
       {{"(lev v1)", now.level_v1 / 10 + 0.03},
        {"(level a1)", now.level_a1 / 10 - 0.04},
        {"(level a2)", now.level_a2 / 10 + 0.02}}},
      {"goal",
       {{{"text", "(is-at v1 f1)"}, {"met", over}},
        {{"text", "(= (level a1) 5)"}, {"met", over}},
        {{"text", "(= (level a2) 5)"}, {"met", time_s > 72.3}},
        {{"text", "(= (received c1) 7)"}, {"met", time_s > 36.2}},
        {{"text", "(= (received c2) 10)"}, {"met", time_s > 72.3}}}},
      {"makespan_s", over ? json(end_s()) : json(nullptr)},
      {"report", nullptr}};
  return document.dump();
}

protocol::Synoptic bench_synoptic() {
  protocol::Synoptic s;
  for (const auto& [id, label] :
       {std::pair{"v1", "vehicle v1"}, {"a1", "distributor a1"}, {"a2", "distributor a2"}}) {
    s.points.push_back({std::string(id) + ".level", label, "%", true});
    s.points.push_back({std::string(id) + ".truth", std::string(label) + ", true", "%", true});
  }
  s.points.push_back({"f1.truth", "supplier f1, true", "%", false});
  for (const char* id : {"v1.position", "v1.left", "v1.right", "fc1", "fc2", "fc3", "B1", "B2", "B3", "B4"}) {
    s.points.push_back({id, id, "", false});
  }
  s.places = {{"a1", "a1", -1, "fc2"}, {"f1", "f1", 0, "fc1"}, {"a2", "a2", 1, "fc3"}};
  s.vehicles = {{"v1", "v1", "v1.position", "v1.left", "v1.right"}};
  using protocol::TankSide;
  s.tanks = {{"f1", "supplier f1", TankSide::Above, "f1", "", "f1.truth", 0, 0},
             {"v1", "vehicle v1", TankSide::OnVehicle, "v1", "v1.level", "v1.truth", 15, 0},
             {"a1", "distributor a1", TankSide::Below, "a1", "a1.level", "a1.truth", 15, 0},
             {"a2", "distributor a2", TankSide::Below, "a2", "a2.level", "a2.truth", 15, 0}};
  s.pumps = {{"B1", "load pump", "B1", ""},
             {"B2", "unload pump", "B2", ""},
             {"B3", "customer pump of a1", "B3", ""},
             {"B4", "customer pump of a2", "B4", ""}};
  s.pipes = {{"f1", "v1", "B1", "f1"},
             {"v1", "a1", "B2", "a1"},
             {"v1", "a2", "B2", "a2"},
             {"a1", "f1", "B3", ""},
             {"a2", "f1", "B4", ""}};
  return s;
}

}  // namespace stepwright::browser
