#include "programs/supervisor/cell_mission.h"

#include <atomic>
#include <optional>
#include <thread>
#include <utility>

#include "programs/config/executive_options.h"
#include "programs/fleet/fleet_executive_options.h"
#include "supervisor/executive/goal_form.h"

namespace stepwright::supervisor_program {
namespace {

result::Result<void> not_here(const char* hint) {
  return result::fail("X0003", {}, "this cell does not take such requests", hint);
}

result::Result<void> over() {
  return result::fail("X0008", {}, "the run is over", "start another one");
}

class PlannedMission final : public CellMission {
 public:
  PlannedMission(const config::CellConfig& config, executive::PlanningDesk desk)
      : options_(config::executive_options(config)),
        desk_(std::move(desk)),
        what_if_(desk_, config::what_if_options(config)),
        outlook_(desk_) {}

  void begin(run::Controller& controller, Observer observer) override {
    executive_.emplace(desk_, controller, options_, std::move(observer));
  }
  run::RunRecord run() override { return executive_->run(); }
  bool wait_start(std::chrono::milliseconds timeout) override { return executive_->wait_start(timeout); }

  result::Result<void> obey(const OperatorRequest& request) override {
    if (const auto* start = std::get_if<StartRequest>(&request))
      return executive_->request_start(start->goal);
    if (const auto* question = std::get_if<WhatIfRequest>(&request))
      return what_if_.ask({question->id, question->goal, executive_->outlook()});
    if (const auto* cancel = std::get_if<CancelWhatIfRequest>(&request)) return what_if_.cancel(cancel->id);
    if (std::holds_alternative<fleet::FleetChange>(request))
      return not_here("it has no fleet; change a fluent or the goal");
    return executive_->over() ? over() : obey_in_run(request);
  }

  std::string goal_form() const override { return executive::goal_form_json(desk_); }
  std::optional<std::string> new_outlook() override {
    const std::pair now{executive_->outlook_revision(), what_if_.revision()};
    if (told_ == now) return std::nullopt;
    told_ = now;
    return outlook_.json(executive_->outlook(), what_if_.answer());
  }

 private:
  result::Result<void> obey_in_run(const OperatorRequest& request) {
    if (std::holds_alternative<HoldRequest>(request)) return executive_->request_hold();
    if (std::holds_alternative<ResumeRequest>(request)) return executive_->request_resume();
    if (const auto* goal = std::get_if<GoalRequest>(&request)) return executive_->request_goal(goal->goal);
    if (const auto* change = std::get_if<ChangeRequest>(&request))
      return executive_->request_change(change->fluent, change->value);
    executive_->request_abort();
    return {};
  }

  executive::ExecutiveOptions options_;
  executive::PlanningDesk desk_;
  std::optional<executive::Executive> executive_;
  executive::WhatIf what_if_;
  executive::OutlookWriter outlook_;
  std::optional<std::pair<std::uint64_t, std::uint64_t>> told_;  // revisions of outlook and what-if
};

// Its run begins at the starts of its problem and its goals are loads: neither another start from where the
// vehicles are nor a plan beside the one that is driven is to be had.
class FleetMission final : public CellMission {
 public:
  FleetMission(const config::CellConfig& config, fleet::FleetDesk desk)
      : options_(config::fleet_executive_options(config)), desk_(std::move(desk)) {}

  void begin(run::Controller& controller, Observer observer) override {
    executive_.emplace(desk_, controller, options_, std::move(observer));
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
      return not_here("a fleet has no what-if on the page: `stepwright fleet` plans without driving");
    if (over_)
      return result::fail("X0008", {}, "the run is over", "start the supervisor again for another one");
    if (std::holds_alternative<AbortRequest>(request)) {
      executive_->request_abort();
      return {};
    }
    if (std::holds_alternative<HoldRequest>(request)) return executive_->request(fleet::HoldChange{});
    if (std::holds_alternative<ResumeRequest>(request)) return executive_->request(fleet::ResumeChange{});
    if (const auto* change = std::get_if<fleet::FleetChange>(&request)) return executive_->request(*change);
    return not_here("it has a fleet: order, block, unblock, return, hold, resume, abort");
  }

  std::string goal_form() const override {
    return executive::no_goal_form_json("a fleet has orders, no goals: give it a new order");
  }
  std::optional<std::string> new_outlook() override { return std::nullopt; }

 private:
  result::Result<void> obey(const StartRequest& start) {
    if (over_) return not_here("a fleet begins where its problem has it begin: start the supervisor again");
    if (!start.goal.empty()) return not_here("a fleet has orders, no goals: start it without one");
    return executive_->request_start();
  }

  fleet::FleetExecutiveOptions options_;
  fleet::FleetDesk desk_;
  std::optional<fleet::FleetExecutive> executive_;
  std::atomic<bool> over_{false};
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
