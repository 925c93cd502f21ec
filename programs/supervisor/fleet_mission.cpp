#include "programs/supervisor/fleet_mission.h"

#include <atomic>
#include <optional>
#include <thread>
#include <utility>

#include "programs/fleet/fleet_executive_options.h"
#include "runtime/service/answer_codes.h"
#include "supervisor/executive/goal_form.h"

namespace stepwright::supervisor_program {
namespace {

// Its run begins at the starts of its problem and its goals are loads: neither another start from where the
// vehicles are nor a plan beside the one that is driven is to be had.
class FleetMission final : public CellMission {
 public:
  FleetMission(const config::CellConfig& config, fleet::FleetPlanning planning)
      : options_(config::fleet_executive_options(config)), planning_(std::move(planning)) {}

  void begin(run::Controller& controller, Observer observer) override {
    executive_.emplace(planning_, controller, options_, std::move(observer));
  }
  run::RunRecord run() override {
    const run::RunRecord record = executive_->run();
    over_ = true;
    return record;
  }
  bool wait_start(std::chrono::milliseconds timeout) override {
    std::this_thread::sleep_for(timeout);
    return false;
  }

  result::Result<void> obey(const OperatorRequest& request) override {
    if (const auto* start = std::get_if<StartRequest>(&request)) return obey(*start);
    if (std::holds_alternative<WhatIfRequest>(request) ||
        std::holds_alternative<CancelWhatIfRequest>(request))
      return not_of_this_cell("a fleet has no what-if on the page: `stepwright fleet` plans without driving");
    if (over_)
      return result::fail(service::kNotNow, {}, "the run is over",
                          "start the supervisor again for another one");
    if (std::holds_alternative<AbortRequest>(request)) {
      executive_->request_abort();
      return {};
    }
    if (std::holds_alternative<HoldRequest>(request)) return executive_->request(fleet::HoldChange{});
    if (std::holds_alternative<ResumeRequest>(request)) return executive_->request(fleet::ResumeChange{});
    if (const auto* change = std::get_if<fleet::FleetChange>(&request)) return executive_->request(*change);
    return not_of_this_cell("it has a fleet: order, block, unblock, return, hold, resume, abort");
  }

  std::string goal_form() const override {
    return executive::no_goal_form_json("a fleet has orders, no goals: give it a new order");
  }
  std::optional<std::string> new_outlook() override { return std::nullopt; }

 private:
  result::Result<void> obey(const StartRequest& start) {
    if (over_)
      return not_of_this_cell("a fleet begins where its problem has it begin: start the supervisor again");
    if (!start.goal.empty()) return not_of_this_cell("a fleet has orders, no goals: start it without one");
    return executive_->request_start();
  }

  fleet::FleetExecutiveOptions options_;
  fleet::FleetPlanning planning_;
  std::optional<fleet::FleetExecutive> executive_;
  std::atomic<bool> over_{false};
};

}  // namespace

bool has_fleet(const config::CellConfig& config) {
  return !config.fleet.problem.empty();
}

result::Result<std::unique_ptr<CellMission>> open_fleet_mission(const config::CellConfig& config) {
  auto planning = config::open_fleet_planning(config);
  if (!planning) return result::forward(planning);
  return std::make_unique<FleetMission>(config, *std::move(planning));
}

}  // namespace stepwright::supervisor_program
