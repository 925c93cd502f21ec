#pragma once

// Plan + binding -> sequential function chart (the paper's Figure 13, made general). Every action of the plan
// becomes a step that drives the action's outputs; the transition out of it is the observed completion; the
// next action starts only if its precondition is observed too. Actions that the plan's partial order leaves
// unordered run in simultaneous branches. supervisor/doc/plan_to_sfc.md states the rules.
//
// Chart: START (initial snapshot within tolerance) -> S01_LOAD [-> R01_LOAD rest] -> ... -> SETTLE -> DONE.
//   W01_09            action 9 waits for action 1 (branches that diverge or converge); W00 = START
//   FAILED_S01_LOAD   action 1 could not start (precondition not observed) or did not end (timeout, a hold
//                     fact lost); no outputs
// Lowering, compiling and drawing take `Translation::project` as any hand-written one.
//
// Pure functions; the result is a value. Use from any thread.
//
//   auto translation = translate(run, *binding, {.interval_us = 10'000});
//   lowering::lower_sfc(translation->project)

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ladder/graphic/project.h"
#include "runtime/ground/result/result.h"
#include "supervisor/model/planned_run.h"
#include "supervisor/translate/binding.h"
#include "supervisor/translate/change.h"
#include "supervisor/translate/sensor_condition.h"

namespace stepwright::translate {

struct TranslateOptions {
  bool sequential = false;  // one action after the other, as in the paper
  std::int64_t interval_us = 10'000;
  Tare tare{};
  // Fluents as measured at the start, where they differ from the plan's rounded initial state (replanning);
  // empty = as planned.
  std::map<std::string, double> measured{};
  // Rungs that watch the plan (monitors.h), and actions whose outputs do nothing are stopped early.
  bool monitors = false;
};

enum class StepKind : std::uint8_t { Start, Action, Rest, Wait, Settle, Done, Failed, Search };

// Meaning of a chart step for those that follow the program.
struct StepInfo {
  std::string name;
  StepKind kind = StepKind::Wait;
  std::optional<std::size_t> action;  // Action, Rest, Failed: index into the plan
  std::vector<std::size_t> after;     // actions that are done when this step is active, and with them all
                                      // that are ordered before them
  milliseconds timeout{0};            // Action and Search; 0 = none
  milliseconds idle{0};               // Action: by then something must have happened; 0 = not watched
  std::vector<std::string> assumed;   // Action: parts of its precondition that no sensor can check
};

enum class MonitorKind : std::uint8_t { Precondition, Invariant, Effect, Motion, Standstill, Rate };

// A monitor of the program: the reading that its rungs watch (monitors.h).
struct Monitor {
  std::optional<std::size_t> action;  // index into the plan; none: watched all the time
  MonitorKind kind = MonitorKind::Invariant;
  std::string text;     // for people: "level of a2 within 0.2 of 2"
  std::string reading;  // the variable whose value is kept
  std::string sensor;   // of the binding, if the reading is its filtered counts
};

struct Translation {
  graphic::Project project;                // globals, PROGRAM sensors, PROGRAM plan with the chart, one task
  std::string program;                     // name of the POU with the chart
  std::string instance;                    // and of its instance, under which the container lists the chart
  std::vector<StepInfo> steps;             // in the order of the chart's steps
  std::vector<model::Ordering> orderings;  // the reduced order that the chart realises
  model::NamedState initial;               // measured where measured values were given
  std::vector<Change> changes;             // of each action
  std::vector<graphic::Condition> guards;  // of each action: what is observed of its precondition
  std::vector<Monitor> monitors;           // empty without monitors

  const graphic::SfcChart& chart() const;
  // Index into `steps`; nullopt for a name that is no step.
  std::optional<std::size_t> step(std::string_view name) const;
};

// Fails, located in the binding where it can be: T0001 an action that no entry matches, T0002 an ordering
// that contradicts the list, T0003 an atom that the states do not know, T0004 a completion that the action
// does not bring about or that its sensor cannot see, T0005 a precondition that does not hold in the plan
// itself, T0006 names of the binding that collide with generated ones.
[[nodiscard]] result::Result<Translation> translate(const model::PlannedRun& run, const Binding& binding,
                                                    const TranslateOptions& options = {});

// The state that should be measured once the actions with `done[i]` are done (indices as in the plan).
model::NamedState expected_state(const Translation& translation, const std::vector<bool>& done);

}  // namespace stepwright::translate
