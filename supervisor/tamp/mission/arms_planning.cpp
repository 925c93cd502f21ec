#include "supervisor/tamp/mission/arms_planning.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "ladder/driver/compile.h"
#include "supervisor/tamp/mission/retreat.h"
#include "supervisor/tamp/mission/way_home.h"
#include "supervisor/tamp/planner/skeleton_planner.h"
#include "supervisor/tamp/schedule/schedule_plan.h"

namespace stepwright::tamp::mission {
namespace {

using std::chrono::steady_clock;

// Where no way home is found, or motions bring the arms too near: with other paths, and the other arm first.
constexpr std::size_t kTries = 3;

// Counted work, so that all machines end alike: configurations that failed, motions that searches of paths
// have checked, plans of tasks. Some seconds on one core; plans that are found take a thousandth of it.
struct Effort {
  std::uint64_t failed = 0, path_motions = 0, skeletons = 0;
};
// While only what is wanted is moved, by way of where things change hands; then with all that can be moved.
constexpr Effort kFirst{100'000, 100'000, 60}, kAll{400'000, 300'000, 80};
constexpr std::uint64_t kFirstPathMotions = 10'000;  // of a sequence, before others are tried
constexpr std::uint64_t kMostStates = 1'000'000;     // of the searches for plans of tasks

constexpr double kObstacleMargin_m = 0.01;  // of where the camera has it

// A body of that kind, as large as those that the cell has.
scene::Form form_of(const scene::RobotCell& cell, int kind) {
  if (kind == kObstacle) {
    scene::Form form = cell.obstacle;
    form.radius_m += kObstacleMargin_m;
    form.size_x_m += 2.0 * kObstacleMargin_m;
    form.size_y_m += 2.0 * kObstacleMargin_m;
    form.height_m += kObstacleMargin_m;
    return form;
  }
  for (const scene::Thing& each : cell.things)
    if (kind_of(each) == kind) return each.form;
  return {.round = true, .radius_m = 0.05, .height_m = 0.12};
}

}  // namespace

program::ArmsProgramOptions program_options() {
  program::ArmsProgramOptions options;
  options.reports = 5;
  options.camera_every = std::chrono::milliseconds(250);
  return options;
}

result::Result<ArmsPlanning> ArmsPlanning::open(ArmsPlanningOptions options) {
  ArmsPlanning planning(std::move(options));
  const scene::RobotCell& cell = planning.options_.cell;
  if (auto good = check_names(cell); !good) return result::forward(good);
  for (const scene::Thing& each : cell.things)
    if (kind_of(each) == 0)
      return result::fail("G0407", {}, "nobody knows what the camera calls '" + each.name + "'",
                          "kind = \"cup\", \"can\", \"tray\" or \"box\" of the [[object]]");
  const scene::GeometricState start = initial_state(cell);
  const std::string problem = problem_text(cell, planning.first_order(), start, nullptr);
  if (auto read = planner::read_skeletons(planning.options_.domain, {"order.pddl", problem}); !read)
    return result::forward(read);
  return planning;
}

result::Result<ArmsOrder> ArmsPlanning::order(const std::string& text) const {
  const auto known = std::ranges::find(options_.orders, text, &ArmsOrder::name);
  if (known != options_.orders.end()) return *known;
  if (!text.starts_with('(')) {
    std::string names;
    for (const ArmsOrder& each : options_.orders) names += (names.empty() ? "" : ", ") + each.name;
    return result::fail("G0401", {"goal", 1, 1}, "there is no order '" + text + "'",
                        "orders are " + names + "; or a goal: (in cup1 red-region)");
  }
  return read_order(options_.cell, text, text, "goal");
}

// Things stand where they do now, and what nobody has a name for stands there for good.
scene::RobotCell ArmsPlanning::cell_with(const std::vector<Seen>& strangers,
                                         const scene::GeometricState& state) const {
  scene::RobotCell cell = options_.cell;
  for (std::size_t k = 0; k < cell.things.size(); ++k) cell.things[k].start = state.things[k].pose;
  for (std::size_t k = 0; k < strangers.size(); ++k)
    cell.furniture.push_back(
        {"stranger " + std::to_string(k + 1), form_of(cell, strangers[k].kind), strangers[k].pose});
  return cell;
}

result::Result<std::vector<scene::PlannedAction>> ArmsPlanning::actions_for(
    const ArmsPlanRequest& request, const scene::RobotCell& cell, const scene::GeometricState& state,
    std::uint64_t seed) const {
  if (not_yet(cell, state, *request.order).empty()) return std::vector<scene::PlannedAction>();
  const planner::IntervalModel model(cell);
  planner::TampOptions how;
  how.seed = seed;
  how.cancel = request.cancel;
  how.until = steady_clock::now() + std::chrono::duration_cast<steady_clock::duration>(
                                        std::chrono::duration<double>(options_.most_s));
  planner::TampOutcome outcome;
  for (const bool all : {false, true}) {
    auto task = planner::read_skeletons(
        options_.domain,
        {"order.pddl", problem_text(cell, *request.order, state, all ? nullptr : &options_.exchange)});
    if (!task) return result::forward(task);
    const Effort& effort = all ? kAll : kFirst;
    how.most_failed = effort.failed;
    how.most_path_motions = effort.path_motions;
    how.first_path_motions = kFirstPathMotions;
    how.most_skeletons = effort.skeletons;
    how.most_states = kMostStates;
    outcome = planner::plan(cell, *task, model, how);
    if (outcome.plan) return std::move(outcome.plan->actions);
  }
  const bool proved = outcome.kind == model::OutcomeKind::Infeasible;
  return result::fail(proved ? kNoPlan : kNotFound, {},
                      (proved ? "no plan exists for " : "no plan was found for ") + request.order->name +
                          (outcome.reason.empty() ? "" : ": " + outcome.reason),
                      "another order, or see to what is in the way");
}

result::Result<PreparedArms> ArmsPlanning::plan(const ArmsPlanRequest& request) const {
  const auto began = steady_clock::now();
  result::Diagnostics why;
  for (std::size_t tried = 0; tried < kTries; ++tried) {
    const std::uint64_t seed = options_.seed + tried;
    PreparedArms prepared;
    prepared.start = request.state;
    prepared.strangers = request.strangers;
    auto first = way_home(cell_with(request.strangers, request.state), request.state, request.order->wanted,
                          {.seed = seed,
                           .leaves = true,
                           .last_first = tried % 2 == 1,
                           .back = request.back,
                           .known = &options_.cell});
    if (!first) {
      why = first.error();
      continue;
    }
    scene::RobotCell cell = cell_with(request.strangers, first->after);
    auto actions = actions_for(request, cell, first->after, seed);
    if (!actions) return result::forward(actions);
    auto last = way_home(cell, state_after(cell, first->after, *actions), {}, {.seed = seed});
    if (!last) {
      why = last.error();
      continue;
    }
    for (auto* part : {&first->actions, &*actions, &last->actions})
      for (scene::PlannedAction& each : *part) prepared.plan.actions.push_back(std::move(each));
    auto schedule = schedule::schedule_plan(cell, request.state, prepared.plan, {.seed = seed});
    if (!schedule) {
      why = schedule.error();
      continue;
    }
    prepared.schedule = *std::move(schedule);
    prepared.cell = std::make_shared<const scene::RobotCell>(std::move(cell));
    if (!request.only_looked_at)
      if (auto made = compile(program::ArmsProgramKind::Follow, 0, prepared); !made) {
        why = made.error();
        continue;
      }
    prepared.spent_ms = std::chrono::duration<double, std::milli>(steady_clock::now() - began).count();
    return prepared;
  }
  return tl::unexpected(std::move(why));
}

result::Result<PreparedArms> ArmsPlanning::retreat(const ArmsRetreatRequest& request) const {
  const auto began = steady_clock::now();
  const scene::RobotCell there = cell_with(request.strangers, request.state);
  scene::RobotCell known = cell_with({}, request.state);
  const motion::JointPath way =
      mission::retreat({known, there, request.state, options_.seed}, request.arm, request.back);
  if (way.empty())
    return result::fail(kNoWayHome, {}, "the " + known.arms[request.arm].name + " arm cannot go back");
  PreparedArms prepared;
  prepared.retreats = true;
  prepared.start = request.state;
  prepared.strangers = request.strangers;
  const scene::ArmState& arm = request.state.arms[request.arm];
  scene::PlannedAction action{
      {scene::ActionKind::MoveAway, static_cast<int>(request.arm), std::max(0, arm.near)}, 0.0, {}, {}};
  action.motions.push_back({scene::Phase::Transfer, arm.half_open_m, way});
  prepared.plan.actions.push_back(std::move(action));
  // The same way, not another one that keeps farther from the other arm.
  constexpr double kSameWay_rad = 0.01;
  auto schedule = schedule::schedule_plan(known, request.state, prepared.plan,
                                          {.blend_rad = kSameWay_rad, .clear_m = 0.0, .seed = options_.seed});
  if (!schedule) return result::forward(schedule);
  prepared.schedule = *std::move(schedule);
  prepared.cell = std::make_shared<const scene::RobotCell>(std::move(known));
  if (auto made = compile(program::ArmsProgramKind::Follow, 0, prepared); !made) return result::forward(made);
  prepared.spent_ms = std::chrono::duration<double, std::milli>(steady_clock::now() - began).count();
  return prepared;
}

result::Result<PreparedArms> ArmsPlanning::halt(const PreparedArms& driven) const {
  PreparedArms prepared = driven;
  if (auto made = compile(program::ArmsProgramKind::Halt, 0, prepared); !made) return result::forward(made);
  return prepared;
}

result::Result<PreparedArms> ArmsPlanning::observe(std::uint32_t reset) const {
  PreparedArms prepared;
  if (auto made = compile(program::ArmsProgramKind::Observe, reset, prepared); !made)
    return result::forward(made);
  return prepared;
}

result::Result<void> ArmsPlanning::compile(program::ArmsProgramKind kind, std::uint32_t reset,
                                           PreparedArms& prepared) const {
  program::ArmsProgramOptions options = options_.program;
  options.reset = reset;
  const bool looks = kind == program::ArmsProgramKind::Observe;
  auto made = program::arms_program({.kind = kind,
                                     .cell = looks ? &options_.cell : prepared.cell.get(),
                                     .schedule = looks ? nullptr : &prepared.schedule},
                                    options_.terminals, options);
  if (!made) return result::forward(made);
  prepared.program = *std::move(made);
  driver::CompileInput input;
  input.projects.push_back(&prepared.program.project);
  input.document = true;
  input.watchers = options_.watchers;
  auto output = driver::compile(input);
  if (!output) return result::forward(output);
  prepared.container = std::move(output->container);
  return {};
}

}  // namespace stepwright::tamp::mission
