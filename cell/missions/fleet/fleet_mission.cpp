// The cell of a fleet ([fleet]).

#include <utility>

#include "cell/missions/fleet/check_fleet.h"
#include "cell/missions/fleet/fleet_executive_options.h"
#include "cell/missions/mission_kinds.h"

namespace stepwright::missions {
namespace {

class FleetPlanner final : public CellPlanner {
 public:
  FleetPlanner(config::CellConfig config, fleet::FleetPlanning planning)
      : config_(std::move(config)), planning_(std::move(planning)) {}

  std::unique_ptr<run::Mission> mission(run::Controller& controller,
                                        run::Mission::Observer observer) override {
    return std::make_unique<fleet::FleetExecutive>(planning_, controller, fleet_executive_options(config_),
                                                   std::move(observer));
  }
  result::Result<FirstPlan> first_plan() override { return first_fleet_plan(config_, planning_); }

 private:
  const config::CellConfig config_;
  fleet::FleetPlanning planning_;
};

}  // namespace

result::Result<std::unique_ptr<CellPlanner>> open_fleet(const config::CellConfig& config) {
  auto planning = open_fleet_planning(config);
  if (!planning) return result::forward(planning);
  return std::make_unique<FleetPlanner>(config, *std::move(planning));
}

}  // namespace stepwright::missions
