#include "cell/trial/action_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "cell/missions/planning/executive_options.h"
#include "cell/runtime/cell_io.h"
#include "cell/simulation/simulated_controller.h"
#include "ladder/driver/compile.h"
#include "plant_models/bridge/port_map.h"
#include "supervisor/pddl/plan/describe_run.h"
#include "supervisor/pddl/task/vocabulary.h"
#include "supervisor/run/image_reader.h"
#include "supervisor/translate/estimate.h"
#include "supervisor/translate/observe_program.h"
#include "supervisor/translate/sensor_program.h"

namespace stepwright::trial {
namespace {

using simulation::SimulatedController;
using std::chrono::milliseconds;
using translate::StepKind;

// Of its timeout, and at least so much more.
constexpr int kTimes = 5;
constexpr milliseconds kLeastMore{10'000};
constexpr milliseconds kLongest{3'600'000};
// So many tolerances the other way are no noise.
constexpr double kWrongWay = 4.0;
// From reading to reading while an action is watched.
constexpr int kScansPerLook = 10;
// For the plant to show the initial state, behind the binding's own wait.
constexpr double kStartPatience_s = 30.0;

double seconds(milliseconds time) {
  return std::chrono::duration<double>(time).count();
}

milliseconds given_to(milliseconds timeout) {
  return std::min(std::max(timeout * kTimes, timeout + kLeastMore), std::max(timeout, kLongest));
}

// The binding, with more time for the entry of the action.
translate::Binding patient(const translate::Binding& binding, const model::GroundAction& action) {
  translate::Binding made = binding;
  translate::Assignment assignment;
  const translate::ActionBinding* const entry = binding.action_for(action, assignment);
  for (std::size_t i = 0; i < binding.actions.size(); ++i)
    if (&binding.actions[i] == entry) made.actions[i].timeout = given_to(entry->timeout);
  return made;
}

result::Result<std::vector<std::byte>> compile(const TrialCell& cell, const graphic::Project& project) {
  auto joined = cell.programs.joined(project);
  if (!joined) return result::forward(joined);
  auto output = driver::compile({.texts = {},
                                 .projects = joined->projects(),
                                 .dialect = &missions::planning_table(cell.config).dialect()});
  if (!output) return result::forward(output);
  return std::move(output->container);
}

// The cell's plant as it is at the beginning, and the scan. Fails as CellIo::create() does of a plant.
result::Result<std::unique_ptr<SimulatedController>> fresh_controller(const config::CellConfig& config) {
  auto plant = cell_runtime::fresh_plant(config);
  if (!plant) return result::forward(plant);
  const auto wires = cell_runtime::plant_wires(config);
  const bridge::AreaSizes sizes{config.image.input_bytes, config.image.output_bytes};
  if (auto wired = bridge::check_wires(**plant, wires, sizes); !wired) return result::forward(wired);
  host::HostConfig host;
  host.input_bytes = sizes.input_bytes;
  host.output_bytes = sizes.output_bytes;
  return std::make_unique<SimulatedController>(std::move(*plant), wires, sizes,
                                               std::vector<simulation::PlantFault>{}, std::move(host));
}

// What the program at hand reads of the plant.
std::vector<std::string> read_variables(const translate::Binding& binding) {
  std::vector<std::string> names;
  for (const translate::ObservedFact& fact : binding.facts) names.push_back(fact.tag);
  for (const translate::Sensor& sensor : binding.sensors)
    names.push_back(translate::filtered_variable(sensor));
  return names;
}

Reading observed(const translate::Binding& binding, const model::NamedState& state) {
  Reading reading;
  for (const translate::ObservedFact& fact : binding.facts)
    reading[fact.fact] = state.facts.contains(fact.fact) ? 1.0 : 0.0;
  for (const translate::Sensor& sensor : binding.sensors)
    if (const auto value = state.fluents.find(sensor.fluent); value != state.fluents.end())
      reading[sensor.fluent] = value->second;
  return reading;
}

// A program in the scan, with all that its image is read by.
class Running {
 public:
  Running(SimulatedController& controller, const translate::Binding& binding,
          const model::NamedState& tracked)
      : controller_(controller), binding_(binding), tracked_(tracked) {}

  [[nodiscard]] result::Result<void> load(const TrialCell& cell, const translate::Translation& translation) {
    auto container = compile(cell, translation.project);
    if (!container) return result::forward(container);
    auto reader = run::ImageReader::create(*container, translation.instance, read_variables(binding_));
    if (!reader) return result::forward(reader);
    reader_.emplace(std::move(*reader));
    if (auto loaded = controller_.download(*container); !loaded) return result::forward(loaded);
    return controller_.start(false);
  }

  std::vector<bool> steps() const { return reader_->active_steps(controller_.image()); }
  translate::Values values() const { return reader_->values(controller_.image()); }
  Reading reading(const translate::Tare& tare) const {
    const auto now = translate::estimate(binding_, values(), tare, tracked_);
    return now ? observed(binding_, now->measured) : Reading();
  }

 private:
  SimulatedController& controller_;
  const translate::Binding& binding_;
  const model::NamedState& tracked_;
  std::optional<run::ImageReader> reader_;
};

// The bias of the sensors that are tared, as every run begins with it.
result::Result<translate::Tare> tare_of(const TrialCell& cell, SimulatedController& controller,
                                        const model::NamedState& known) {
  const auto tared = [](const translate::Sensor& sensor) { return sensor.tare; };
  if (std::ranges::none_of(cell.binding.sensors, tared)) return translate::Tare();
  translate::ObserveOptions options;
  options.window = cell.config.executive.settle;
  options.interval_us = cell.config.clock.interval_us;
  const translate::Translation look = translate::observe_program(cell.binding, options);
  Running running(controller, cell.binding, known);
  if (auto loaded = running.load(cell, look); !loaded) return result::forward(loaded);
  const double until_s = controller.now_s() + seconds(options.rest + options.window) + kStartPatience_s;
  while (controller.scan_once() && controller.now_s() < until_s) {
    const std::vector<bool> steps = running.steps();
    for (std::size_t i = 0; i < steps.size(); ++i)
      if (steps[i] && look.steps[i].kind == StepKind::Done)
        return translate::identify_tare(cell.binding, running.values(), known);
  }
  return result::fail("T0010", {cell.binding.file, 0, 0}, "the sensors could not be averaged for their tare");
}

// Follows the chart of one run.
class Watch {
 public:
  Watch(const translate::Binding& binding, const translate::Translation& translation,
        const model::PlannedRun& run)
      : binding_(binding), translation_(translation), run_(run), tried_(run.actions.size() - 1) {
    translate::Assignment assignment;
    const translate::ActionBinding& entry = *binding.action_for(run.actions[tried_].action, assignment);
    given_s_ = seconds(entry.timeout);
    if (entry.completion.kind != translate::CompletionKind::Fluent) return;
    level_ = translate::instantiate(entry.completion.atom, assignment);
    tolerance_ = binding.sensor_of(level_)->tolerance;
    const model::PlannedAction& planned = run.actions[tried_];
    rises_ = planned.after.fluents.at(level_) > planned.before.fluents.at(level_);
  }

  ActionRun follow(SimulatedController& controller, const Running& running, const translate::Tare& tare) {
    ActionRun result;
    result.planned = run_.actions[tried_];
    result.given_s = given_s_;
    const double begun_s = controller.now_s();
    double active_from_s = -1.0;
    for (std::uint64_t n = 0; controller.scan_once(); ++n) {
      const translate::StepInfo* const step = step_of(running.steps());
      const bool active = step != nullptr && step->kind == StepKind::Action && step->action == tried_;
      if (active && active_from_s < 0.0) {
        active_from_s = controller.now_s();
        result.before = running.reading(tare);
      }
      if (active) result.active_s = controller.now_s() - active_from_s;
      if (active && n % kScansPerLook == 0 && wrong_way(result.before, running.reading(tare))) {
        return ended(std::move(result), RunEnd::WrongWay, running.reading(tare));
      }
      if (step == nullptr) continue;
      if (step->kind == StepKind::Done) return ended(std::move(result), RunEnd::Done, running.reading(tare));
      if (step->kind == StepKind::Failed)
        return failed(std::move(result), *step, active_from_s, running.reading(tare));
      const double start_s = begun_s + seconds(binding_.start) + kStartPatience_s;
      if (step->kind == StepKind::Start && controller.now_s() > start_s)
        return not_begun(std::move(result), running.reading(tare));
    }
    return ended(std::move(result), RunEnd::Trapped, running.reading(tare));
  }

 private:
  // The one that says most: the chart is a sequence.
  const translate::StepInfo* step_of(const std::vector<bool>& active) const {
    for (std::size_t i = 0; i < active.size(); ++i)
      if (active[i]) return &translation_.steps[i];
    return nullptr;
  }

  bool wrong_way(const Reading& before, const Reading& now) const {
    if (level_.empty()) return false;
    const auto from = before.find(level_);
    const auto to = now.find(level_);
    if (from == before.end() || to == now.end()) return false;
    const double change = to->second - from->second;
    return (rises_ ? -change : change) > kWrongWay * tolerance_;
  }

  ActionRun ended(ActionRun result, RunEnd end, Reading after) const {
    result.end = end;
    result.after = std::move(after);
    const std::vector<bool> all(run_.actions.size(), true);
    result.expected = observed(binding_, translate::expected_state(translation_, all));
    return result;
  }

  ActionRun failed(ActionRun result, const translate::StepInfo& step, double active_from_s,
                   Reading after) const {
    if (!step.action) return not_begun(std::move(result), std::move(after));
    if (step.action != tried_) {
      result.detail = model::to_string(run_.actions[*step.action].action);
      return ended(std::move(result), RunEnd::NotReached, std::move(after));
    }
    if (active_from_s < 0.0) {
      result.before = after;
      return ended(std::move(result), RunEnd::Refused, std::move(after));
    }
    constexpr double kOneScan_s = 0.1;
    const bool in_time = result.active_s < given_s_ - kOneScan_s;
    return ended(std::move(result), in_time ? RunEnd::HoldLost : RunEnd::TimedOut, std::move(after));
  }

  ActionRun not_begun(ActionRun result, Reading after) const {
    const model::NamedState shown = as_shown(binding_, run_.initial, after);
    for (const std::string& each : translate::deviations(binding_, run_.initial, shown))
      result.detail += (result.detail.empty() ? "" : "; ") + each;
    result = ended(std::move(result), RunEnd::NotBegun, std::move(after));
    result.expected = observed(binding_, run_.initial);
    return result;
  }

  const translate::Binding& binding_;
  const translate::Translation& translation_;
  const model::PlannedRun& run_;
  std::size_t tried_;
  double given_s_ = 0.0;
  std::string level_;  // that completes it; empty: a fact does
  double tolerance_ = 0.0;
  bool rises_ = false;
};

}  // namespace

model::NamedState as_shown(const translate::Binding& binding, model::NamedState state,
                           const Reading& reading) {
  for (const auto& [atom, value] : reading) {
    if (binding.observed(atom) == nullptr) {
      state.fluents[atom] = value;
    } else if (value > 0.5) {
      state.facts.insert(atom);
    } else {
      state.facts.erase(atom);
    }
  }
  return state;
}

result::Result<TrialCell> TrialCell::open(const config::CellConfig& config) {
  const missions::PlanningTable& table = missions::planning_table(config);
  auto task = pddl::load_task(table.domain.string(), table.problem.string());
  if (!task) return result::forward(task);
  const model::Vocabulary vocabulary = pddl::vocabulary(*task);
  auto binding = translate::load_binding(table.binding, &vocabulary);
  if (!binding) return result::forward(binding);
  auto programs = executive::HandWritten::load(table.programs, table.dialect());
  if (!programs) return result::forward(programs);
  return TrialCell{config, std::move(*task), std::move(*binding), std::move(*programs)};
}

result::Result<ActionRun> run_action(const TrialCell& cell, const std::vector<model::GroundAction>& before,
                                     const model::GroundAction& action, std::uint64_t seed) {
  model::Plan plan;
  plan.actions = before;
  plan.actions.push_back(action);
  auto run = pddl::describe_run(cell.task, plan);
  if (!run) return result::forward(run);
  config::CellConfig config = cell.config;
  config.plant.seed = seed;
  auto controller = fresh_controller(config);
  if (!controller) return result::forward(controller);
  auto tare = tare_of(cell, **controller, run->initial);
  if (!tare) return result::forward(tare);
  const translate::Binding binding = patient(cell.binding, action);
  auto translation = translate::translate(
      *run, binding, {.sequential = true, .interval_us = cell.config.clock.interval_us, .tare = *tare});
  if (!translation) {
    ActionRun unbound;
    unbound.end = RunEnd::NotBound;
    unbound.planned = run->actions.back();
    unbound.problems = std::move(translation.error());
    return unbound;
  }
  Running running(**controller, binding, run->initial);
  if (auto loaded = running.load(cell, *translation); !loaded) return result::forward(loaded);
  ActionRun result = Watch(binding, *translation, *run).follow(**controller, running, *tare);
  result.seed = seed;
  result.simulated_s = (*controller)->now_s();
  return result;
}

}  // namespace stepwright::trial
