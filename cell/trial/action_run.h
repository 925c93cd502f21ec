#pragma once

// One action alone on the simulated plant: a chart of the actions that lead to where it may start and of the
// action itself, translated and compiled as every plan, in the real scan. Its timeout is left out of account:
// it gets as much as tells a slow action from one without effect.
//
//   auto cell = TrialCell::open(config);
//   auto run = run_action(*cell, start.before, {"load", {"v1", "f1", "level8"}}, 7);
//   run->end == RunEnd::Done
//
// Threads: a TrialCell is immutable; runs of it may be made by any number of threads.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cell/config/cell_config.h"
#include "runtime/ground/result/result.h"
#include "supervisor/executive/hand_written.h"
#include "supervisor/model/planned_run.h"
#include "supervisor/pddl/task/task.h"
#include "supervisor/translate/binding.h"

namespace stepwright::trial {

// What all runs of a cell share.
struct TrialCell {
  config::CellConfig config;
  pddl::Task task;
  translate::Binding binding;
  executive::HandWritten programs;

  // Fails with every problem of the files of [planning]. Requires that the cell has [planning].
  [[nodiscard]] static result::Result<TrialCell> open(const config::CellConfig& config);
};

enum class RunEnd : std::uint8_t {
  Done,
  NotBound,    // it cannot be executed as it is bound: `problems`
  NotBegun,    // the plant is not where the problem's :init says
  NotReached,  // an action before it has failed
  Refused,     // its precondition is not observed
  HoldLost,    // a fact that must stay true did not
  TimedOut,    // its completion did not come in the time that it was given
  WrongWay,    // its level goes the other way
  Trapped,     // the program or the plant has failed
};

// What sensors show: observed atoms with their values, 0 or 1 of facts.
using Reading = std::map<std::string, double>;

// The state with what sensors show in it.
model::NamedState as_shown(const translate::Binding& binding, model::NamedState state,
                           const Reading& reading);

struct ActionRun {
  std::uint64_t seed = 0;
  RunEnd end = RunEnd::Trapped;
  std::string detail;        // NotBegun: what is shown instead; NotReached: the action that failed
  double active_s = 0.0;     // its outputs were on
  double given_s = 0.0;      // that it could have had
  double simulated_s = 0.0;  // of the whole run
  Reading before;            // as it begins
  Reading after;             // with all at rest, or as the run ended
  Reading expected;          // of `after`, by the domain and the binding; NotBegun: by :init
  model::PlannedAction planned;
  result::Diagnostics problems;  // NotBound
};

// Fails where its program cannot be compiled, or the plant cannot be made.
[[nodiscard]] result::Result<ActionRun> run_action(const TrialCell& cell,
                                                   const std::vector<model::GroundAction>& before,
                                                   const model::GroundAction& action, std::uint64_t seed);

}  // namespace stepwright::trial
