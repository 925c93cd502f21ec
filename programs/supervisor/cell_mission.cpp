#include "programs/supervisor/cell_mission.h"

#include <optional>
#include <utility>

#include "programs/config/executive_options.h"
#include "programs/fleet/fleet_executive_options.h"

namespace stepwright::supervisor_program {
namespace {

result::Result<void> not_here(const char* hint) {
  return result::fail("X0003", {}, "this cell does not take such requests", hint);
}

class PlannedMission final : public CellMission {
 public:
  PlannedMission(const config::CellConfig& config, executive::PlanningDesk desk)
      : options_(config::executive_options(config)), desk_(std::move(desk)) {}

  void begin(executive::Controller& controller, Observer observer) override {
    executive_.emplace(desk_, controller, options_, std::move(observer));
  }
  executive::RunRecord run() override { return executive_->run(); }
  result::Result<void> obey(const OperatorRequest& request) override {
    if (std::holds_alternative<AbortRequest>(request)) {
      executive_->request_abort();
      return {};
    }
    if (std::holds_alternative<HoldRequest>(request)) return executive_->request_hold();
    if (std::holds_alternative<ResumeRequest>(request)) return executive_->request_resume();
    if (const auto* goal = std::get_if<GoalRequest>(&request)) return executive_->request_goal(goal->goal);
    if (const auto* change = std::get_if<ChangeRequest>(&request))
      return executive_->request_change(change->fluent, change->value);
    return not_here("it has no fleet; change a fluent or the goal");
  }

 private:
  executive::ExecutiveOptions options_;
  executive::PlanningDesk desk_;
  std::optional<executive::Executive> executive_;
};

class FleetMission final : public CellMission {
 public:
  FleetMission(const config::CellConfig& config, fleet::FleetDesk desk)
      : options_(config::fleet_executive_options(config)), desk_(std::move(desk)) {}

  void begin(executive::Controller& controller, Observer observer) override {
    executive_.emplace(desk_, controller, options_, std::move(observer));
  }
  executive::RunRecord run() override { return executive_->run(); }
  result::Result<void> obey(const OperatorRequest& request) override {
    if (std::holds_alternative<AbortRequest>(request)) {
      executive_->request_abort();
      return {};
    }
    if (std::holds_alternative<HoldRequest>(request)) return executive_->request(fleet::HoldChange{});
    if (std::holds_alternative<ResumeRequest>(request)) return executive_->request(fleet::ResumeChange{});
    if (const auto* change = std::get_if<fleet::FleetChange>(&request)) return executive_->request(*change);
    return not_here("it has a fleet: order, block, unblock, return, hold, resume, abort");
  }

 private:
  fleet::FleetExecutiveOptions options_;
  fleet::FleetDesk desk_;
  std::optional<fleet::FleetExecutive> executive_;
};

}  // namespace

result::Result<std::unique_ptr<CellMission>> CellMission::open(const config::CellConfig& config) {
  if (!config.fleet.problem.empty()) {
    auto desk = config::open_fleet_desk(config);
    if (!desk) return result::forward(desk);
    return std::make_unique<FleetMission>(config, *std::move(desk));
  }
  auto desk = executive::PlanningDesk::open(config::desk_options(config));
  if (!desk) return result::forward(desk);
  return std::make_unique<PlannedMission>(config, *std::move(desk));
}

}  // namespace stepwright::supervisor_program
