#include "programs/plan/plan_command.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>

#include "programs/plan/output.h"
#include "programs/plan/progress_line.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/process/interruption.h"
#include "runtime/ground/result/counted.h"
#include "supervisor/model/outcome_name.h"
#include "supervisor/pddl/plan/plan_file.h"
#include "supervisor/pddl/plan/validate.h"
#include "supervisor/pddl/planner/solve.h"

namespace stepwright::plan {
namespace {

using result::ExitCode;

constexpr double kDefaultTimeS = 10.0;

nlohmann::json to_json(const model::Outcome& outcome) {
  nlohmann::json json = {{"outcome", name_of(outcome.kind)},
                         {"reason", outcome.reason},
                         {"plan", nlohmann::json::array()},
                         {"orderings", nlohmann::json::array()},
                         {"plan_steps", nullptr},
                         {"plan_cost", nullptr},
                         {"bound", nullptr},
                         {"proved_optimal", false},
                         {"first_plan_ms", nullptr},
                         {"wall_ms", outcome.wall_ms},
                         {"expanded", outcome.expanded},
                         {"peak_mb", outcome.peak_mb}};
  if (!outcome.plan) return json;
  const model::Plan& plan = *outcome.plan;
  for (const model::GroundAction& action : plan.actions) json["plan"].push_back(model::to_string(action));
  for (const model::Ordering& o : plan.orderings.value_or(std::vector<model::Ordering>())) {
    json["orderings"].push_back({o.before, o.after});
  }
  json["plan_steps"] = plan.actions.size();
  json["plan_cost"] = number(plan.cost);
  json["bound"] = number(plan.bound);
  json["proved_optimal"] = plan.proved_optimal;
  json["first_plan_ms"] = outcome.first_plan_ms;
  return json;
}

pddl::Options options_of(const PlanArguments& arguments, ProgressLine& line) {
  pddl::Options options;
  options.optimal = arguments.optimal;
  options.first_only = arguments.first;
  const double time_s = arguments.time_s.value_or(arguments.optimal ? 0.0 : kDefaultTimeS);
  options.budget.time = std::chrono::milliseconds(std::llround(std::ceil(time_s * 1000.0)));
  options.budget.memory_mb = arguments.memory_mb;
  options.threads = arguments.threads;
  options.on_progress = [&line](const pddl::Progress& progress) { line.show(progress); };
  return options;
}

bool is_valid(const pddl::Task& task, const model::Plan& plan) {
  pddl::PlanText text;
  text.actions = plan.actions;
  text.lines.assign(plan.actions.size(), 0);
  return pddl::validate(task, text, pddl::KeepStates::Last).valid;
}

// A plan that is found goes to its file at once, so that it is there whatever ends the process. A stream gets
// the last one only.
void write_when_found(const pddl::Task& task, const PlanArguments& arguments, pddl::Options& options) {
  if (arguments.out_file.empty() || files::is_stream(arguments.out_file)) return;
  options.on_improvement = [&task, &arguments](const model::Plan& plan) {
    if (is_valid(task, plan)) write_file(arguments.out_file, pddl::print_plan(plan));
  };
}

// Ctrl-C and SIGTERM end the search with the best plan so far.
model::Outcome search(const pddl::Task& task, const PlanArguments& arguments) {
  const process::Interruption interruption;
  ProgressLine line(progress_mode(arguments.progress));
  pddl::Options options = options_of(arguments, line);
  options.cancel = interruption.flag();
  write_when_found(task, arguments, options);
  return pddl::solve(task, options);
}

void print(const model::Outcome& outcome) {
  if (!outcome.plan) {
    const bool none = outcome.kind == model::OutcomeKind::Infeasible;
    std::fprintf(stderr, "%s: %s\n", none ? "no plan exists" : "no plan was found", outcome.reason.c_str());
    return;
  }
  const model::Plan& plan = *outcome.plan;
  std::fputs(pddl::print_plan(plan).c_str(), stdout);
  std::string proof = "optimal, proved";
  if (!plan.proved_optimal) {
    proof = std::isfinite(plan.bound) ? "bound " + pddl::number_text(plan.bound) : "no bound known";
  }
  std::printf("; %s, %s; first plan after %.2f ms, done after %.2f ms, %s expanded\n",
              result::counted(plan.actions.size(), "step", "steps").c_str(), proof.c_str(),
              outcome.first_plan_ms, outcome.wall_ms,
              result::counted(outcome.expanded, "state", "states").c_str());
  std::fflush(stdout);  // before what --json writes, which may go the same way
  if (!outcome.reason.empty()) std::fprintf(stderr, "%s\n", outcome.reason.c_str());
}

ExitCode exit_code(const model::Outcome& outcome) {
  if (outcome.plan) return ExitCode::Done;
  return outcome.kind == model::OutcomeKind::Infeasible ? ExitCode::NoPlan : ExitCode::BudgetExhausted;
}

}  // namespace

ExitCode run_plan(const PlanArguments& arguments) {
  auto task = pddl::load_task(arguments.domain, arguments.problem);
  if (!task) {
    print_diagnostics(task.error());
    return ExitCode::BadInput;
  }
  print_diagnostics(task->warnings());
  if (!check_writable({arguments.json_file, arguments.out_file, arguments.picture.svg_file})) {
    return ExitCode::BadInput;
  }
  const auto picture = PlanPicture::prepare(*task, arguments.picture);
  if (!picture) return ExitCode::BadInput;
  const model::Outcome outcome = search(*task, arguments);
  print(outcome);
  if (!arguments.json_file.empty() && !write_file(arguments.json_file, to_json(outcome).dump(2) + "\n")) {
    return ExitCode::BadInput;
  }
  if (!arguments.out_file.empty() && outcome.plan &&
      !write_file(arguments.out_file, pddl::print_plan(*outcome.plan))) {
    return ExitCode::BadInput;
  }
  if (outcome.plan && !picture->draw(*task, *outcome.plan)) return ExitCode::BadInput;
  return exit_code(outcome);
}

}  // namespace stepwright::plan
