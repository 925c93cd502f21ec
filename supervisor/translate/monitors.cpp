#include "supervisor/translate/monitors.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>

#include "ladder/graphic/identifier.h"
#include "supervisor/translate/action_conditions.h"
#include "supervisor/translate/internal/expectation.h"
#include "supervisor/translate/internal/monitor_names.h"
#include "supervisor/translate/internal/pace.h"
#include "supervisor/translate/internal/watch_chart.h"
#include "supervisor/translate/sensor_program.h"

namespace stepwright::translate {
namespace {

using internal::Expectation;
using internal::expectations;
using internal::fail_flag;
using internal::had_failed_flag;
using internal::kAlarmsTold;
using internal::kNow;
using internal::last_variable;
using internal::mark_variable;
using internal::numbered;
using internal::ran_flag;
using internal::run_flag;
using internal::since_variable;
using internal::still_variable;
using internal::watch_program;

using graphic::Condition;
using graphic::Rung;
using graphic::Variable;
using graphic::VariableSection;

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

Variable variable(std::string name, std::string type, VariableSection section) {
  Variable declared;
  declared.name = std::move(name);
  declared.type = std::move(type);
  declared.section = section;
  return declared;
}

// The sensors whose calibrated values an expression reads.
std::vector<std::string> values_in(const Condition& expression, const Binding& binding) {
  std::vector<std::string> names;
  for (const Sensor& sensor : binding.sensors) {
    if (mentions(expression.name, value_variable(sensor))) names.push_back(value_variable(sensor));
  }
  return names;
}

// The first variable that a condition reads.
std::string reading_of(const Condition& condition, const Binding& binding) {
  if (condition.kind == graphic::ConditionKind::Contact ||
      condition.kind == graphic::ConditionKind::Comparison) {
    return condition.name;
  }
  if (condition.kind == graphic::ConditionKind::Expression) {
    const std::vector<std::string> values = values_in(condition, binding);
    return values.empty() ? std::string() : values.front();
  }
  for (const Condition& child : condition.children) {
    if (std::string name = reading_of(child, binding); !name.empty()) return name;
  }
  return {};
}

class Monitors {
 public:
  Monitors(Translation& translation, const model::PlannedRun& run, const Binding& binding, const Tare& tare)
      : translation_(translation), run_(run), binding_(binding), tare_(tare) {}

  result::Result<void> add() {
    if (auto taken = check_names(); !taken) return taken;
    const std::vector<Expectation> expected = expectations(translation_, run_, binding_);
    count_scan();
    for (const Sensor& sensor : binding_.sensors) rate(sensor);
    for (std::size_t i = 0; i < run_.actions.size(); ++i) section(i, expected[i]);
    end_label();
    flag_steps();
    declare();
    return {};
  }

 private:
  result::Result<void> check_names() const {
    graphic::NameSet names;
    for (const Variable& each : translation_.project.globals) names.insert(each.name);
    std::vector<std::string> needed = {kAlarmCount, kNow, kAlarmsTold, "MON_SCAN", "MON_VALUE"};
    for (std::size_t i = 0; i < run_.actions.size(); ++i) {
      needed.insert(needed.end(), {run_flag(i), fail_flag(i), ran_flag(i), had_failed_flag(i),
                                   mark_variable(i), since_variable(i)});
    }
    for (const Sensor& sensor : binding_.sensors) {
      needed.push_back(still_variable(sensor));
      needed.push_back(last_variable(sensor));
    }
    for (const std::string& name : needed) {
      if (names.insert(name)) continue;
      return result::fail("T0006", {binding_.file, 0, 0}, "'" + name + "' is a name of the monitors",
                          "rename the tag");
    }
    return {};
  }

  std::int64_t interval_us() const { return translation_.project.tasks.front().interval_us; }

  void count_scan() {
    graphic::Block block;
    block.st_body = std::string(kNow) + " := " + kNow + " + 1;";
    Rung rung;
    rung.comment = "scans since the program began";
    rung.blocks.push_back(std::move(block));
    ladder_.rungs.push_back(std::move(rung));
  }

  // The sensor program counts the scans in every scan, also while no plan runs.
  void rate(const Sensor& sensor) {
    if (sensor.max_rate == 0.0) return;
    raise(
        {std::nullopt, MonitorKind::Rate,
         sensor.label + " changes by no more than " + short_number(sensor.max_rate) + " in a second",
         sensor.tag, sensor.name},
        graphic::always(),
        graphic::compare(leaping_variable(sensor), graphic::CompareOp::Less, std::to_string(kLeapingScans)));
  }

  void section(std::size_t action, const Expectation& expected) {
    const std::size_t first = ladder_.rungs.size();
    preconditions(action);
    invariants(action, expected);
    effects(action, expected);
    motion(action);
    progress(action);
    if (ladder_.rungs.size() == first) return;
    remember(action);
    Rung skip;
    skip.label = std::exchange(next_label_, numbered("AFTER", action + 1));
    skip.comment = to_string(run_.actions[action].action);
    skip.condition =
        graphic::all({graphic::contact(run_flag(action), true), graphic::contact(ran_flag(action), true),
                      graphic::contact(fail_flag(action), true)});
    skip.jump_to = next_label_;
    ladder_.rungs.insert(ladder_.rungs.begin() + static_cast<std::ptrdiff_t>(first), std::move(skip));
    watched_.push_back(action);
  }

  // In the scan in which the chart goes to FAILED without having run the action.
  void preconditions(std::size_t action) {
    const Condition& guard = translation_.guards[action];
    const Condition refused =
        graphic::all({graphic::contact(fail_flag(action)), graphic::contact(had_failed_flag(action), true),
                      graphic::contact(run_flag(action), true), graphic::contact(ran_flag(action), true)});
    const std::vector<Condition> parts =
        guard.kind == graphic::ConditionKind::All ? guard.children : std::vector<Condition>{guard};
    for (const Condition& part : parts) {
      raise({action, MonitorKind::Precondition, graphic::to_st(part), reading_of(part, binding_), {}},
            refused, part);
    }
  }

  void invariants(std::size_t action, const Expectation& expected) {
    const Condition runs = graphic::contact(run_flag(action));
    watch(action, MonitorKind::Invariant, runs, expected.during, [&](const std::string& atom) {
      return !expected.own.contains(atom) && !expected.elsewhere.contains(atom);
    });
  }

  void effects(std::size_t action, const Expectation& expected) {
    const Condition done =
        graphic::all({graphic::contact(ran_flag(action)), graphic::contact(run_flag(action), true),
                      graphic::contact(fail_flag(action), true)});
    watch(action, MonitorKind::Effect, done, expected.after, [&](const std::string& atom) {
      return expected.own.contains(atom) && !expected.elsewhere.contains(atom);
    });
  }

  void motion(std::size_t action) {
    Assignment assignment;
    const ActionBinding& entry = *binding_.action_for(run_.actions[action].action, assignment);
    if (entry.completion.kind != CompletionKind::Fluent) return;
    const Sensor& sensor = *binding_.sensor_of(instantiate(entry.completion.atom, assignment));
    if (!sensor.must_move || !internal::shows_motion(sensor, run_.actions[action], binding_)) return;
    const std::string still = still_variable(sensor);
    const std::string last = last_variable(sensor);
    graphic::Block count;
    count.st_body = "IF " + sensor.tag + " = " + last + " THEN " + still + " := " + still + " + 1; ELSE " +
                    still + " := 0; END_IF; " + last + " := " + sensor.tag + ";";
    Rung counts;
    counts.comment = "scans for which " + sensor.tag + " has not changed";
    counts.condition = graphic::contact(run_flag(action));
    counts.blocks.push_back(std::move(count));
    ladder_.rungs.push_back(std::move(counts));
    const std::string most = std::to_string(internal::kStill_us / interval_us());
    raise({action, MonitorKind::Motion, sensor.name + " changes while it should", sensor.tag, sensor.name},
          graphic::contact(run_flag(action)), graphic::compare(still, graphic::CompareOp::Less, most));
    graphic::Block clear;
    clear.st_body = still + " := 0;";
    Rung clears;
    clears.condition = graphic::contact(run_flag(action), true);
    clears.blocks.push_back(std::move(clear));
    ladder_.rungs.push_back(std::move(clears));
    moved_.insert(sensor.name);
  }

  // While the outputs of an action are on, the level that completes it goes on where it should.
  void progress(std::size_t action) {
    const model::PlannedAction& planned = run_.actions[action];
    Assignment assignment;
    const ActionBinding& entry = *binding_.action_for(planned.action, assignment);
    const auto pace = internal::pace_of(planned, binding_);
    if (!pace || entry.outputs.empty()) return;
    const Sensor& sensor = *pace->sensor;
    std::vector<Condition> on{graphic::contact(run_flag(action))};
    std::string all_on;
    for (const std::string& output : entry.outputs) {
      on.push_back(graphic::contact(output));
      all_on += (all_on.empty() ? "" : " AND ") + output;
      read_.insert(output);
    }
    const std::string filtered = filtered_variable(sensor);
    const std::string mark = mark_variable(action);
    const std::string since = since_variable(action);
    const std::string now = as_dint(filtered);
    graphic::Block count;
    count.st_body = "IF NOT " + ran_flag(action) + " OR NOT (" + all_on + ") OR " +
                    (pace->rises ? now + " - " + mark : mark + " - " + now) +
                    " >= " + std::to_string(pace->least_counts) + " THEN " + mark + " := " + now + "; " +
                    since + " := 0; ELSE " + since + " := " + since + " + 1; END_IF;";
    Rung counts;
    counts.comment = "scans for which the " + sensor.label + " has not gone on";
    counts.condition = graphic::contact(run_flag(action));
    counts.blocks.push_back(std::move(count));
    ladder_.rungs.push_back(std::move(counts));
    const double scans = pace->within_s * 1e6 / static_cast<double>(interval_us());
    raise(
        {action, MonitorKind::Standstill, sensor.label + " goes on while it is moved", filtered, sensor.name},
        graphic::all(std::move(on)),
        graphic::compare(since, graphic::CompareOp::Less, std::to_string(std::llround(scans))));
    paced_.push_back(action);
  }

  template <typename Wanted>
  void watch(std::size_t action, MonitorKind kind, const Condition& when, const model::NamedState& state,
             const Wanted& wanted) {
    for (const ObservedFact& fact : binding_.facts) {
      if (!wanted(fact.fact)) continue;
      const bool holds = state.facts.contains(fact.fact);
      raise({action, kind, (holds ? "'" : "not '") + fact.label + "'", fact.tag, {}}, when,
            fact_is(fact, holds));
    }
    for (const Sensor& sensor : binding_.sensors) {
      const auto value = state.fluents.find(sensor.fluent);
      if (value == state.fluents.end() || !wanted(sensor.fluent)) continue;
      const Condition within =
          near(sensor, binding_.tag(sensor.tag)->type, tare_, value->second, sensor.tolerance);
      raise(
          {action, kind,
           sensor.label + " within " + short_number(sensor.tolerance) + " of " + short_number(value->second),
           filtered_variable(sensor), sensor.name},
          when, within);
    }
  }

  // A rung that raises the alarm once when `when` holds and `expected` does not.
  void raise(Monitor monitor, const Condition& when, const Condition& expected) {
    const auto lost = inverse(expected);
    if (!lost || monitor.reading.empty()) return;
    const std::size_t number = translation_.monitors.size();
    const std::string scan = alarm_scan_variable(number);
    graphic::Block block;
    block.st_body = scan + " := " + kNow + "; " + alarm_value_variable(number) +
                    " := " + as_dint(monitor.reading) + "; " + kAlarmCount + " := " + kAlarmCount + " + 1;";
    Rung rung;
    rung.comment = std::string(to_string(monitor.kind)) + ": " + monitor.text;
    rung.condition = graphic::all({when, graphic::compare(scan, graphic::CompareOp::Equal, "0"), *lost});
    rung.blocks.push_back(std::move(block));
    ladder_.rungs.push_back(std::move(rung));
    read_.insert(monitor.reading);
    collect(*lost);
    translation_.monitors.push_back(std::move(monitor));
  }

  std::string as_dint(const std::string& name) const {
    for (const Sensor& sensor : binding_.sensors) {
      const std::string& type = binding_.tag(sensor.tag)->type;
      if (filtered_variable(sensor) == name || sensor.tag == name) return type + "_TO_DINT(" + name + ")";
      if (value_variable(sensor) == name) return "REAL_TO_DINT(" + name + ")";
    }
    return "BOOL_TO_DINT(" + name + ")";
  }

  void collect(const Condition& condition) {
    if (condition.kind == graphic::ConditionKind::Contact ||
        condition.kind == graphic::ConditionKind::Comparison) {
      read_.insert(condition.name);
    }
    if (condition.kind == graphic::ConditionKind::Expression) {
      const std::vector<std::string> values = values_in(condition, binding_);
      read_.insert(values.begin(), values.end());
    }
    for (const Condition& child : condition.children) collect(child);
  }

  void remember(std::size_t action) {
    for (const auto& [now, before] : {std::pair(run_flag(action), ran_flag(action)),
                                      std::pair(fail_flag(action), had_failed_flag(action))}) {
      Rung rung;
      rung.condition = graphic::contact(now);
      rung.coils.push_back({graphic::CoilKind::Normal, before});
      ladder_.rungs.push_back(std::move(rung));
    }
  }

  // The last section is jumped over to here.
  void end_label() {
    if (next_label_.empty()) return;
    Rung rung;
    rung.label = next_label_;
    rung.is_return = true;
    ladder_.rungs.push_back(std::move(rung));
  }

  graphic::Pou& plan() {
    return *std::ranges::find(translation_.project.pous, translation_.program, &graphic::Pou::name);
  }

  void flag_steps() {
    auto& chart = std::get<graphic::SfcChart>(plan().body);
    const std::set<std::size_t> watched(watched_.begin(), watched_.end());
    for (std::size_t i = 0; i < translation_.steps.size(); ++i) {
      const StepInfo& step = translation_.steps[i];
      if (!step.action || !watched.contains(*step.action)) continue;
      graphic::ActionBlock block;
      block.target = step.kind == StepKind::Failed ? fail_flag(*step.action) : run_flag(*step.action);
      chart.steps[i].actions.push_back(std::move(block));
    }
  }

  void declare() {
    graphic::Project& project = translation_.project;
    const std::string size = std::to_string(std::max<std::size_t>(1, translation_.monitors.size()));
    std::vector<Variable> flags;
    for (const std::size_t action : watched_) {
      flags.push_back(variable(run_flag(action), "BOOL", VariableSection::Global));
      flags.push_back(variable(fail_flag(action), "BOOL", VariableSection::Global));
    }
    std::vector<Variable> alarms = {
        variable("MON_SCAN", "ARRAY[1.." + size + "] OF UDINT", VariableSection::Global),
        variable("MON_VALUE", "ARRAY[1.." + size + "] OF DINT", VariableSection::Global),
        variable(kAlarmCount, "UDINT", VariableSection::Global)};
    graphic::Pou monitors;
    monitors.name = kMonitorProgram;
    for (const Variable& global : project.globals) {
      if (!read_.contains(global.name)) continue;
      monitors.variables.push_back(variable(global.name, global.type, VariableSection::External));
    }
    for (const Variable& flag : flags) {
      plan().variables.push_back(variable(flag.name, flag.type, VariableSection::External));
      monitors.variables.push_back(variable(flag.name, flag.type, VariableSection::External));
    }
    for (const Variable& alarm : alarms) {
      monitors.variables.push_back(variable(alarm.name, alarm.type, VariableSection::External));
    }
    monitors.variables.push_back(variable(kNow, "UDINT", VariableSection::Local));
    for (const Sensor& sensor : binding_.sensors) {
      if (!moved_.contains(sensor.name)) continue;
      monitors.variables.push_back(variable(still_variable(sensor), "DINT", VariableSection::Local));
      monitors.variables.push_back(
          variable(last_variable(sensor), binding_.tag(sensor.tag)->type, VariableSection::Local));
    }
    for (const std::size_t action : paced_) {
      monitors.variables.push_back(variable(mark_variable(action), "DINT", VariableSection::Local));
      monitors.variables.push_back(variable(since_variable(action), "DINT", VariableSection::Local));
    }
    for (const std::size_t action : watched_) {
      monitors.variables.push_back(variable(ran_flag(action), "BOOL", VariableSection::Local));
      monitors.variables.push_back(variable(had_failed_flag(action), "BOOL", VariableSection::Local));
    }
    monitors.body = std::move(ladder_);
    project.globals.insert(project.globals.end(), flags.begin(), flags.end());
    project.globals.insert(project.globals.end(), alarms.begin(), alarms.end());
    project.pous.push_back(std::move(monitors));
    project.pous.push_back(watch_program(kAlarmCount));
    project.instances.push_back({kMonitorProgram, kMonitorProgram, "main"});
    project.instances.push_back({kWatchProgram, kWatchProgram, "main"});
  }

  Translation& translation_;
  const model::PlannedRun& run_;
  const Binding& binding_;
  const Tare& tare_;
  graphic::LadderProgram ladder_;
  std::string next_label_;  // where the section before jumps to
  std::vector<std::size_t> watched_;
  std::set<std::string> moved_;     // sensors whose counts are compared with the last ones
  std::vector<std::size_t> paced_;  // actions whose level has to go on
  std::set<std::string> read_;      // globals that the rungs read
};

}  // namespace

std::string alarm_scan_variable(std::size_t monitor) {
  return "MON_SCAN[" + std::to_string(monitor + 1) + "]";
}

std::string alarm_value_variable(std::size_t monitor) {
  return "MON_VALUE[" + std::to_string(monitor + 1) + "]";
}

const char* to_string(MonitorKind kind) {
  switch (kind) {
    case MonitorKind::Precondition:
      return "precondition";
    case MonitorKind::Invariant:
      return "invariant";
    case MonitorKind::Effect:
      return "effect";
    case MonitorKind::Motion:
      return "motion";
    case MonitorKind::Standstill:
      return "standstill";
    case MonitorKind::Rate:
      break;
  }
  return "rate";
}

result::Result<void> add_monitors(Translation& translation, const model::PlannedRun& run,
                                  const Binding& binding, const Tare& tare) {
  return Monitors(translation, run, binding, tare).add();
}

}  // namespace stepwright::translate
