#pragma once

// Common part of the planners of this folder: the workspace, times and figures, how much is tried before a
// sequence is given up for now, and the last check of what is handed out.
//
// Thread rule: one owner, one thread: times of the processor are those of the thread. The cell outlives it.

#include <chrono>
#include <cstddef>
#include <vector>

#include "supervisor/tamp/planner/sequence_solver.h"
#include "supervisor/tamp/planner/tamp_planner.h"
#include "supervisor/tamp/predicates/workspace.h"

namespace stepwright::tamp::planner {

class OutcomeBuilder {
 public:
  OutcomeBuilder(const scene::RobotCell& cell, const TampOptions& options, const IntervalModel* model);

  predicates::Workspace& workspace() { return workspace_; }
  TampOutcome& outcome() { return outcome_; }

  // Until now.
  void take_figures();

  // Each round tries more of each sequence: eight times as many configurations, twice as many samples, and at
  // first four times as many nodes of a path.
  void begin_round(std::size_t round);
  SolverAnswer attempt(const std::vector<scene::ActionSpec>& actions);
  // Whether another round may find more: something was tried in this one, and neither time nor numbers are
  // used up.
  bool worth_another(std::size_t round) const;
  bool used_up() const;
  // Without a plan: whether it was the clock that ended it.
  void close();

  // Certifies the motions; false: the outcome says what is uncertain.
  bool finish(std::vector<predicates::Settled> settled);

 private:
  bool late() const;

  const TampOptions& options_;
  predicates::Workspace workspace_;
  std::chrono::steady_clock::time_point began_;
  double cpu_began_;
  SolverOptions solver_options_;
  std::uint64_t failed_before_ = 0;  // this round
  TampOutcome outcome_;
};

}  // namespace stepwright::tamp::planner
