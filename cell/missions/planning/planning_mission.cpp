// The cell of a PDDL problem ([planning]).

#include <utility>

#include "cell/missions/mission_kinds.h"
#include "cell/missions/planning/executive_options.h"
#include "cell/monitors/cell_monitors.h"
#include "supervisor/pddl/plan/describe_run.h"

namespace stepwright::missions {
namespace {

class PlanningPlanner final : public CellPlanner {
 public:
  PlanningPlanner(executive::ExecutiveOptions options, executive::PlanningService planning)
      : options_(std::move(options)), planning_(std::move(planning)) {}

  std::unique_ptr<run::Mission> mission(run::Controller& controller,
                                        run::Mission::Observer observer) override {
    return std::make_unique<executive::Executive>(planning_, controller, options_, std::move(observer));
  }

  result::Result<FirstPlan> first_plan() override {
    auto outcome = planning_.prepare({.start = {.planning = pddl::to_named(planning_.task().initial())}});
    if (!outcome) return result::forward(outcome);
    executive::PreparedPlan& prepared = outcome->prepared;
    switch (outcome->status) {
      case executive::PrepareStatus::Ready:
        return FirstPlan{prepared.plan.actions.size(), prepared.plan.cost, std::move(prepared.container), {}};
      case executive::PrepareStatus::Infeasible:
        return FirstPlan{.no_plan = outcome->reason, .exit = result::ExitCode::NoPlan};
      default:
        return FirstPlan{.no_plan = outcome->reason, .exit = result::ExitCode::BudgetExhausted};
    }
  }

 private:
  const executive::ExecutiveOptions options_;
  const executive::PlanningService planning_;
};

}  // namespace

result::Result<std::unique_ptr<CellPlanner>> open_planning(const config::CellConfig& config) {
  const auto monitors = cell_monitors::cell_monitors(config);
  if (!monitors) return tl::unexpected(monitors.error());
  executive::PlanningOptions options = planning_options(config);
  options.watchers = cell_monitors::watchers_of(*monitors);
  auto planning = executive::PlanningService::open(options);
  if (!planning) return result::forward(planning);
  return std::make_unique<PlanningPlanner>(executive_options(config), *std::move(planning));
}

}  // namespace stepwright::missions
