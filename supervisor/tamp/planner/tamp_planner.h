#pragma once

// Plans tasks and motions together: decomposition (supervisor/htn) over a cell, by intervals and whole
// sequences (ours) or by geometric backtracking as the paper has it (paper-literal), on the same inverse
// kinematics, paths and checks. A plan is handed out after every motion of it was judged by the bodies
// themselves.
//
// What ends a search without a plan is counted work (configurations, motions of paths, plans of tasks,
// states), so that the same seed gives the same plan or the same "no plan was found" on every machine. A
// deadline is for a machine that is far too slow; where it has ended the search, the outcome says so.
//
// A function without state; any thread, one thread each.
//
//   const IntervalModel model(cell);
//   const TampOutcome outcome = plan(cell, task, &model, {.seed = 1});
//   if (outcome.plan) ...

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "supervisor/htn/plan/plan.h"
#include "supervisor/htn/task/planning_task.h"
#include "supervisor/model/plan.h"
#include "supervisor/tamp/planner/interval_model.h"
#include "supervisor/tamp/scene/tamp_plan.h"

namespace stepwright::tamp::planner {

enum class Method : std::uint8_t {
  Ours,
  PaperLiteral,   // all ways of the arm are part of the count
  PaperFirstWay,  // of each sample the first that works, as the paper chooses
  PaperFromOne,   // all ways; samples from number 1 on (geometric_backtracking.h)
};

struct TampOptions {
  Method method = Method::Ours;
  std::uint64_t seed = 1;
  std::optional<std::chrono::steady_clock::time_point> until;
  const std::atomic<bool>* cancel = nullptr;
  std::uint64_t most_failed = 50'000'000;         // configurations
  std::uint64_t most_path_motions = 500'000'000;  // that searches of paths check (motion/path/plan_path.h)
  std::uint64_t most_skeletons = 100'000;         // in PDDL: plans of actions that geometry judges
  std::uint64_t most_states = 1'000'000'000;      // in PDDL: of all the searches for them
  // Ours, where there is no plan: cells in which one number is another one are planned for, so many at the
  // most, so that what "would do" does. 0: only bounds are told.
  std::size_t most_proposals = 0;
  // Ours: of a sequence, before it is given up for now and others are tried; then those that were given up,
  // with more each time, until something is used up.
  std::uint64_t first_failed = 5'000;
  std::uint64_t first_path_motions = 200'000;  // likewise
};

struct TampFigures {
  double plan_ms = 0.0;      // until there was a sequence with all its motions
  double plan_cpu_ms = 0.0;  // the same, of the thread's processor time
  double certify_ms = 0.0;   // shortening, and judging every motion by the bodies themselves
  std::uint64_t configurations = 0, failed = 0;
  std::uint64_t configurations_again = 0, failed_again = 0;  // paper-literal: in geometric backtracking
  std::uint64_t paths = 0, failed_paths = 0;
  std::uint64_t straight_paths = 0, tree_paths = 0;  // of the paths: the simplest and the hardest
  std::uint64_t path_motions = 0;                    // that searches of paths have checked
  std::uint64_t states = 0;                          // of the searches for skeletons
  std::uint64_t decompositions = 0, refusals = 0;
  std::uint64_t sequences = 0;                           // ours: whole ones for which geometry was looked for
  std::uint64_t refuted = 0;                             // prefixes, by intervals
  std::uint64_t proved_nogoods = 0, budget_nogoods = 0;  // sequences that were given up, and why
  std::uint64_t backjumps = 0, jumped_over = 0;
  std::uint64_t rounds = 0;  // ours: of sequences that were given up for now
};

struct TampOutcome {
  // Solved, Infeasible (proved; with paper-literal: for the resolution of its samples), Exhausted or
  // Cancelled.
  model::OutcomeKind kind = model::OutcomeKind::Exhausted;
  std::optional<scene::TampPlan> plan;
  std::optional<htn::Plan> tasks;
  std::optional<model::Plan> skeleton;  // of a task in PDDL (skeleton_planner.h)
  std::string reason;                   // why there is none
  bool by_clock = false;                // the deadline ended it; on a faster machine it may end otherwise
  TampFigures figures;
};

// The task must have been read with geometric_predicates(). `model`: of the same cell; not needed by
// paper-literal.
TampOutcome plan(const scene::RobotCell& cell, const htn::PlanningTask& task, const IntervalModel* model,
                 const TampOptions& options);

}  // namespace stepwright::tamp::planner
