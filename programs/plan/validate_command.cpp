#include "programs/plan/validate_command.h"

#include <nlohmann/json.hpp>

#include <cstdio>

#include "programs/plan/output.h"
#include "runtime/ground/process/diagnostics_json.h"
#include "runtime/ground/result/counted.h"
#include "supervisor/pddl/plan/validate.h"

namespace stepwright::plan {
namespace {

using result::ExitCode;

nlohmann::json to_json(const pddl::PlanText& plan, const pddl::Validation& validation) {
  nlohmann::json steps = nlohmann::json::array();
  for (std::size_t i = 0; i < validation.trace.states.size(); ++i) {
    const pddl::State& state = validation.trace.states[i];
    steps.push_back({{"step", i},
                     {"action", i == 0 ? "" : model::to_string(plan.actions[i - 1])},
                     {"cost", validation.trace.cost[i]},
                     {"facts", state.facts()},
                     {"fluents", state.fluents()}});
  }
  nlohmann::json goals = nlohmann::json::array();
  for (const pddl::GoalStatus& goal : validation.goals) {
    goals.push_back({{"text", goal.text}, {"met", goal.met}});
  }
  return {{"valid", validation.valid},
          {"plan_steps", plan.actions.size()},
          {"plan_cost", validation.cost()},
          {"failed_step", validation.failed_step},
          {"failed_condition", validation.failed_condition},
          {"failed_values", validation.failed_values},
          {"diagnostics", process::diagnostics_json(validation.diagnostics)},
          {"goals", std::move(goals)},
          {"steps", std::move(steps)}};
}

}  // namespace

ExitCode run_validate(const ValidateArguments& arguments) {
  auto task = pddl::load_task(arguments.domain, arguments.problem);
  if (!task) {
    print_diagnostics(task.error());
    return ExitCode::BadInput;
  }
  print_diagnostics(task->warnings());
  if (!check_writable({arguments.json_file})) return ExitCode::BadInput;
  auto source = pddl::read_source(arguments.plan);
  auto plan = source ? pddl::parse_plan(*source) : result::Result<pddl::PlanText>(result::forward(source));
  if (!plan) {
    print_diagnostics(plan.error());
    return ExitCode::BadInput;
  }
  const bool short_answer = arguments.quiet && arguments.json_file.empty();
  const pddl::Validation validation =
      pddl::validate(*task, *plan, short_answer ? pddl::KeepStates::Last : pddl::KeepStates::All);
  if (!arguments.quiet) std::fputs(pddl::table(*plan, validation).c_str(), stdout);
  print_diagnostics(validation.diagnostics);
  std::printf("plan %s: %s, cost %s%s\n", validation.valid ? "valid" : "invalid",
              result::counted(plan->actions.size(), "step", "steps").c_str(),
              pddl::number_text(validation.cost()).c_str(),
              validation.failed_step == 0
                  ? ""
                  : (" before step " + std::to_string(validation.failed_step) + ", which fails").c_str());
  if (!arguments.json_file.empty() &&
      !write_file(arguments.json_file, to_json(*plan, validation).dump(2) + "\n")) {
    return ExitCode::BadInput;
  }
  return validation.valid ? ExitCode::Done : ExitCode::BadInput;
}

}  // namespace stepwright::plan
