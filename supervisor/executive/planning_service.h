#pragma once

// Makes a program from a state of the plant: plan, translate, lower, compile. Holds what is constant over a
// run (task, binding, options).
//
//   auto service = PlanningService::open({"domain.pddl", "problem.pddl", "binding.toml"});
//   auto prepared = planning->prepare({.start = start});
//
// Immutable after `open`: any thread may use it.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "ladder/driver/watcher.h"
#include "ladder/source/dialect.h"
#include "runtime/ground/result/result.h"
#include "supervisor/executive/hand_written.h"
#include "supervisor/model/plan.h"
#include "supervisor/model/planned_run.h"
#include "supervisor/pddl/task/task.h"
#include "supervisor/run/run_record.h"
#include "supervisor/translate/binding.h"
#include "supervisor/translate/schedule.h"
#include "supervisor/translate/translation.h"

namespace stepwright::executive {

struct PlanningOptions {
  std::filesystem::path domain;
  std::filesystem::path problem;
  std::filesystem::path binding;
  std::vector<std::filesystem::path> programs{};  // hand-written, PLCopen XML; run behind the chart
  bool optimal = true;
  bool sequential = false;
  std::chrono::milliseconds time{10'000};  // budget of one planning
  std::int64_t interval_us = 10'000;
  bool document = true;       // programs bring their sources with them, for the page
  bool monitors = true;       // rungs that watch the plan in the scan (translate/monitors.h)
  std::string report_fluent;  // what the report follows per action, "(transport-cost)"; empty: the metric
  // Extensions of the standard for hand-written programs.
  const source::Dialect* dialect = &source::standard_dialect();
  // Compiled with every plan; and with what only looks at the plant at rest, but for those that read tags of
  // a plan.
  std::vector<driver::Watcher> watchers{};
};

// Where a plan starts: what the planner sees, what was measured, the tare of the sensors.
struct StartState {
  model::NamedState planning{};
  std::map<std::string, double> measured{};  // fluents; empty: as planned
  translate::Tare tare{};
  std::string goal{};  // PDDL; empty: the problem's
};

// A program that is ready to download, with all that is needed to follow it.
struct PreparedPlan {
  StartState start;
  model::Plan plan;
  model::PlannedRun run;
  translate::Translation translation;
  std::vector<std::byte> container;
  run::Episode episode;  // figures and actions, nothing executed yet
};

// Request for a plan: start, plan so far, devices to avoid, budget.
struct PlanRequest {
  StartState start;
  // Remaining actions of the interrupted plan: kept or repaired where that is as good as a new plan.
  std::vector<model::GroundAction> remaining{};
  std::set<std::string> without{};            // devices of the binding that no action of the plan may need
  model::Budget budget{};                     // instead of the planning's; a zero leaves that one
  const std::atomic<bool>* cancel = nullptr;  // not owned; may be null
};

// The value of the metric at the end of a plan (the number of actions without a metric) and at its beginning,
// and how long it takes.
struct PlanWorth {
  double cost = 0.0;
  double cost_before = 0.0;
  double makespan_s = 0.0;
};

enum class PrepareStatus : std::uint8_t { Ready, Infeasible, Exhausted, Cancelled };

struct PrepareOutcome {
  PrepareStatus status = PrepareStatus::Ready;
  std::string reason;     // why there is no plan
  PreparedPlan prepared;  // Ready only
};

class PlanningService {
 public:
  // Reads and checks all files; every problem of each is reported.
  [[nodiscard]] static result::Result<PlanningService> open(const PlanningOptions& options);

  const pddl::Task& task() const { return task_; }
  const translate::Binding& binding() const { return binding_; }
  const PlanningOptions& options() const { return options_; }

  // Plans from the request's start and makes the program. Diagnostics are faults of the binding or of the
  // tools, not of the plan.
  [[nodiscard]] result::Result<PrepareOutcome> prepare(const PlanRequest& request) const;
  // The same plan with its figures, actions and schedule, but neither a chart nor a program: for looking at.
  [[nodiscard]] result::Result<PrepareOutcome> sketch(const PlanRequest& request) const;
  // Worth of another plan: that of these actions from the state, without a search. Fails if they cannot be
  // executed there.
  [[nodiscard]] result::Result<PlanWorth> worth_of(const StartState& start,
                                                   const std::vector<model::GroundAction>& actions) const;
  // The same program again from a plan that is known (a restarted supervisor); episode figures are left
  // empty.
  [[nodiscard]] result::Result<PreparedPlan> rebuild(const StartState& start, const model::Plan& plan) const;
  // The program that only looks (translate/observe_program.h), compiled.
  [[nodiscard]] result::Result<PreparedPlan> observer(bool locate, std::chrono::milliseconds settle) const;

  // Increase of the report's fluent by `action` when it starts in `before`; 0 if it is unknown.
  double cost_of(const model::GroundAction& action, const model::NamedState& before) const;
  // The conjuncts of a goal in a state; an empty goal is the problem's.
  std::vector<run::GoalRecord> goal_status(const model::NamedState& state,
                                           const std::string& goal = {}) const;
  // A goal as PDDL, a conjunct a line; an empty one is the problem's. Requires that check_goal passes.
  std::string goal_text(const std::string& goal) const;
  // Fails as a goal in a problem file would (P0xxx).
  [[nodiscard]] result::Result<void> check_goal(const std::string& goal) const;

 private:
  PlanningService(PlanningOptions options, pddl::Task task, translate::Binding binding, HandWritten programs);
  void find_resting_watchers();
  [[nodiscard]] result::Result<pddl::Task> task_for(const StartState& start) const;
  [[nodiscard]] result::Result<PrepareOutcome> plan_for(const PlanRequest& request,
                                                        const pddl::Task& task) const;
  [[nodiscard]] result::Result<void> order_for_makespan(model::Plan& plan, const pddl::Task& task) const;
  [[nodiscard]] result::Result<void> describe(PreparedPlan& prepared, const pddl::Task& task) const;
  [[nodiscard]] result::Result<void> build(PreparedPlan& prepared, const pddl::Task& task) const;

  PlanningOptions options_;
  pddl::Task task_;
  translate::Binding binding_;
  HandWritten programs_;
  std::vector<driver::Watcher> resting_watchers_{};  // of those of the options
};

}  // namespace stepwright::executive
