#include "programs/supervisor/planned_mission.h"

#include <optional>
#include <utility>

#include "programs/config/executive_options.h"
#include "runtime/service/answer_codes.h"
#include "supervisor/executive/goal_form.h"

namespace stepwright::supervisor_program {
namespace {

class PlannedMission final : public CellMission {
 public:
  PlannedMission(const config::CellConfig& config, executive::PlanningService planning)
      : options_(config::executive_options(config)),
        planning_(std::move(planning)),
        what_if_(planning_, config::what_if_options(config)),
        outlook_(planning_) {}

  void begin(run::Controller& controller, Observer observer) override {
    executive_.emplace(planning_, controller, options_, std::move(observer));
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
      return not_of_this_cell("it has no fleet; change a fluent or the goal");
    if (executive_->over()) return result::fail(service::kNotNow, {}, "the run is over", "start another one");
    return obey_in_run(request);
  }

  std::string goal_form() const override { return executive::goal_form_json(planning_); }
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
  executive::PlanningService planning_;
  std::optional<executive::Executive> executive_;
  executive::WhatIf what_if_;
  executive::OutlookWriter outlook_;
  std::optional<std::pair<std::uint64_t, std::uint64_t>> told_;  // revisions of outlook and what-if
};

}  // namespace

bool has_planning(const config::CellConfig& config) {
  return !config.planning.domain.empty();
}

result::Result<std::unique_ptr<CellMission>> open_planned_mission(const config::CellConfig& config) {
  auto planning = executive::PlanningService::open(config::planning_options(config));
  if (!planning) return result::forward(planning);
  return std::make_unique<PlannedMission>(config, *std::move(planning));
}

}  // namespace stepwright::supervisor_program
