#include "tests/bench/campaign/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <set>

namespace stepwright::campaign {
namespace {

using run::Incident;
using run::IncidentKind;
using run::Phase;
using run::Response;
using run::RunRecord;
using support::SimulatedController;

// A level may be off by the tolerance of its sensor, and by what it moves in the filter's time (0.4 units a
// second in 0.25 s) while somebody draws from it at the end, with its noise.
constexpr double kMotion = 0.15;
constexpr double kPlaceError_m = 0.05;

// The number after `start` in a goal such as "(= (level a1) 5)".
std::optional<double> wanted(const RunRecord& record, const std::string& start) {
  for (const run::GoalRecord& goal : record.goal) {
    if (goal.text.rfind(start, 0) == 0) return std::strtod(goal.text.c_str() + start.size(), nullptr);
  }
  return std::nullopt;
}

std::optional<double> wanted_position(const RunRecord& record) {
  const std::pair<const char*, double> places[] = {
      {"(is-at v1 f1)", 0.0}, {"(is-at v1 a1)", -1.0}, {"(is-at v1 a2)", 1.0}};
  for (const run::GoalRecord& goal : record.goal) {
    for (const auto& [text, position] : places) {
      if (goal.text == text) return position;
    }
  }
  return std::nullopt;
}

// Only a sensor that drifts may have led away from the goal unseen: by what its binding allows to be seen of
// it, and by as much again while a pump moves its tank and no second sensor tells by how much. That is half
// of the time at most.
double level_error(const translate::Sensor& sensor, const Disturbance& disturbance) {
  return sensor.tolerance + (disturbance.drifts() ? 2.0 * sensor.max_drift : kMotion);
}

// Empty if the plant really is where the report says.
std::string wrong_goal(const translate::Binding& binding, const SimulatedController& controller,
                       RunResult& run) {
  for (const char* tank : {"a1", "a2"}) {
    const auto level = wanted(run.record, fmt::format("(= (level {}) ", tank));
    if (!level) return fmt::format("the goal says nothing of {}", tank);
    const double is = controller.plant_value(fmt::format("level_{}_percent", tank)) / 10.0;
    run.level_error = std::max(run.level_error, std::abs(is - *level));
    const translate::Sensor* sensor = binding.sensor_of(fmt::format("(level {})", tank));
    if (std::abs(is - *level) > level_error(*sensor, run.disturbance))
      return fmt::format("{} is {:.2f}, wanted {:g}", tank, is, *level);
  }
  const auto position = wanted_position(run.record);
  if (!position) return "the goal says nothing of the vehicle";
  const double is = controller.plant_value("position");
  if (std::abs(is - *position) > kPlaceError_m) return fmt::format("the vehicle is at {:.2f} m", is);
  for (const run::GoalRecord& goal : run.record.goal) {
    if (!goal.met) return "the report itself says that " + goal.text + " is not met";
  }
  return {};
}

std::set<IncidentKind> plausible(DisturbanceClass of) {
  using K = IncidentKind;
  switch (of) {
    case DisturbanceClass::None:
    case DisturbanceClass::LostRuntime:
      return {};
    case DisturbanceClass::Demand:
      return {K::ChangedDemand};
    case DisturbanceClass::NewGoal:
      return {K::NewGoal};
    case DisturbanceClass::Leak:
      return {K::Leak, K::Level, K::Timeout, K::Refused, K::FailedActuator};
    case DisturbanceClass::WeakPump:
      return {K::FailedActuator, K::Timeout};
    case DisturbanceClass::StuckSwitch:
      return {K::FailedSensor, K::FailedActuator, K::Position, K::Timeout, K::Refused};
    case DisturbanceClass::Drift:
    case DisturbanceClass::FrozenSensor:
      return {K::FailedSensor, K::FailedActuator, K::Leak, K::Level, K::Timeout, K::Refused};
    case DisturbanceClass::Draw:
      return {K::Level, K::Leak, K::Refused};
    case DisturbanceClass::Several:
      break;
  }
  return {K::FailedSensor, K::FailedActuator, K::Leak,    K::Level,         K::Timeout,
          K::Refused,      K::Position,       K::NewGoal, K::ChangedDemand, K::LostRuntime};
}

// Empty if the run was given up for a reason that its disturbance can give.
std::string wrong_stop_of(const RunResult& run) {
  if (std::string wrong = wrong_stop(run.record); !wrong.empty()) return wrong;
  const Incident& last = run.record.incidents.back();
  if (!plausible(run.disturbance.of).contains(last.kind)) {
    return fmt::format("stopped for '{}': {}", to_string(last.kind), run.record.message);
  }
  const bool asked = last.kind == IncidentKind::NewGoal || last.kind == IncidentKind::ChangedDemand;
  if (asked && run.record.message.find("there is no plan") == std::string::npos) {
    return "a wish ended in: " + run.record.message;
  }
  return {};
}

void judge(const translate::Binding& binding, const SimulatedController& controller, RunResult& run) {
  run.why = wrong_end(run.record, controller);
  if (!run.why.empty()) return;
  const bool done = run.record.phase == Phase::Done;
  run.why = done ? wrong_goal(binding, controller, run) : wrong_stop_of(run);
  if (run.why.empty()) run.verdict = done ? Verdict::GoalReached : Verdict::SafeStop;
}

}  // namespace

result::Result<executive::PlanningService> campaign_planning() {
  const std::string cell = STEPWRIGHT_SOURCE_DIR "/tests/cells/bench/";
  executive::PlanningOptions options;
  options.domain = cell + "domain.pddl";
  options.problem = cell + "problem.pddl";
  options.binding = cell + "binding.toml";
  return executive::PlanningService::open(options);
}

RunResult run_once(const executive::PlanningService& planning, const Disturbance& disturbance) {
  const auto start = std::chrono::steady_clock::now();
  RunResult run;
  run.disturbance = disturbance;
  assemblies::BenchParameters parameters;
  parameters.seed = disturbance.seed;
  SimulatedController controller(parameters, disturbance.faults);
  if (disturbance.kill_at_s) controller.kill_runtime_at(*disturbance.kill_at_s);
  executive::ExecutiveOptions options;
  options.cell = "bench";
  options.goal_changes = disturbance.changes;
  try {
    run.record = executive::Executive(planning, controller, options, {}).run();
    judge(planning.binding(), controller, run);
  } catch (const std::exception& problem) {  // a run that hangs or a test harness that cannot go on
    run.why = problem.what();
  }
  run.wall_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return run;
}

}  // namespace stepwright::campaign
