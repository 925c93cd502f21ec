#include "tests/support/arms_program/planned_arms.h"

#include <map>
#include <stdexcept>
#include <utility>

#include "supervisor/tamp/planner/tamp_planner.h"
#include "tests/support/tamp_cells/paper_cells.h"

namespace stepwright::tamp::test {

PlannedArms planned_arms(const std::string& problem, std::uint64_t seed,
                         const schedule::ScheduleOptions& options) {
  auto paper = paper_problem(problem);
  if (!paper) throw std::runtime_error("the problem's files are wrong");
  move_things(paper->cell, seed, 0.01);
  const planner::IntervalModel model(paper->cell);
  planner::TampOptions how;
  how.seed = seed + 1;
  how.most_failed = 100'000;
  const planner::TampOutcome outcome = planner::plan(paper->cell, paper->task, &model, how);
  if (!outcome.plan) throw std::runtime_error("no plan: " + outcome.reason);
  auto made = schedule::schedule_plan(paper->cell, initial_state(paper->cell), *outcome.plan, options);
  if (!made) throw std::runtime_error(result::to_string(made.error()));
  return {std::move(paper->cell), *outcome.plan, *std::move(made)};
}

const PlannedArms& planned_once(const std::string& problem) {
  static std::map<std::string, PlannedArms> known;
  const auto found = known.find(problem);
  return found != known.end() ? found->second : known.emplace(problem, planned_arms(problem)).first->second;
}

}  // namespace stepwright::tamp::test
