// The cell of two arms ([tamp]).

#include <utility>

#include "cell/missions/mission_kinds.h"
#include "cell/missions/tamp/arms_cell.h"

namespace stepwright::missions {
namespace {

using namespace tamp::mission;

class TampPlanner final : public CellPlanner {
 public:
  TampPlanner(ArmsPlanning planning, ArmsMissionOptions options)
      : planning_(std::move(planning)), options_(std::move(options)) {}

  std::unique_ptr<run::Mission> mission(run::Controller& controller,
                                        run::Mission::Observer observer) override {
    return std::make_unique<ArmsMission>(planning_, controller, options_, std::move(observer));
  }

  result::Result<FirstPlan> first_plan() override {
    auto prepared =
        planning_.plan({.order = &planning_.first_order(), .state = initial_state(planning_.cell())});
    if (!prepared) {
      const std::string& code = prepared.error().front().code;
      if (code != kNoPlan && code != kNotFound) return result::forward(prepared);
      return FirstPlan{.no_plan = result::to_string(prepared.error()),
                       .exit = code == kNoPlan ? result::ExitCode::NoPlan : result::ExitCode::BudgetExhausted,
                       .warnings = planning_.options().warnings};
    }
    FirstPlan first;
    first.cost = prepared->schedule.makespan_s;
    first.actions = prepared->plan.actions.size();
    first.program = std::move(prepared->container);
    first.warnings = planning_.options().warnings;
    return first;
  }

 private:
  const ArmsPlanning planning_;
  const ArmsMissionOptions options_;
};

}  // namespace

result::Result<std::unique_ptr<CellPlanner>> open_tamp(const config::CellConfig& config) {
  auto planning = open_arms_planning(config);
  if (!planning) return result::forward(planning);
  auto options = arms_options(config, *planning);
  if (!options) return result::forward(options);
  return std::make_unique<TampPlanner>(*std::move(planning), *std::move(options));
}

}  // namespace stepwright::missions
