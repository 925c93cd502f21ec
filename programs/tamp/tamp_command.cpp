#include "programs/tamp/tamp_command.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "runtime/ground/files/files.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/process/interruption.h"
#include "runtime/ground/result/counted.h"
#include "supervisor/htn/plan/validate.h"
#include "supervisor/htn/task/read_task.h"
#include "supervisor/model/outcome_name.h"
#include "supervisor/pddl/plan/validate.h"
#include "supervisor/tamp/drawing/plan_json.h"
#include "supervisor/tamp/drawing/plan_svg.h"
#include "supervisor/tamp/judge/plan_judge.h"
#include "supervisor/tamp/planner/skeleton_names.h"
#include "supervisor/tamp/planner/skeleton_planner.h"
#include "supervisor/tamp/planner/tamp_planner.h"
#include "supervisor/tamp/predicates/grounding.h"
#include "supervisor/tamp/predicates/names.h"
#include "supervisor/tamp/scene/cell_file.h"

namespace stepwright::tamp_program {

namespace {

using nlohmann::json;
using result::ExitCode;
using tamp::planner::TampOutcome;

ExitCode fail(const result::Diagnostics& diagnostics) {
  (void)process::fail(diagnostics, ExitCode::BadInput);
  return ExitCode::BadInput;
}

json figures_of(const TampOutcome& outcome, double prepare_ms) {
  const tamp::planner::TampFigures& figures = outcome.figures;
  return {{"outcome", name_of(outcome.kind)},
          {"reason", outcome.reason},
          {"prepare_ms", prepare_ms},
          {"plan_ms", figures.plan_ms},
          {"plan_cpu_ms", figures.plan_cpu_ms},
          {"certify_ms", figures.certify_ms},
          {"configurations", figures.configurations},
          {"failed_configurations", figures.failed},
          {"configurations_in_backtracking", figures.configurations_again},
          {"failed_in_backtracking", figures.failed_again},
          {"paths", figures.paths},
          {"straight_paths", figures.straight_paths},
          {"tree_paths", figures.tree_paths},
          {"failed_paths", figures.failed_paths},
          {"sequences", figures.sequences},
          {"refuted_by_intervals", figures.refuted},
          {"proved_nogoods", figures.proved_nogoods},
          {"budget_nogoods", figures.budget_nogoods},
          {"rounds", figures.rounds},
          {"backjumps", figures.backjumps},
          {"jumped_over", figures.jumped_over}};
}

void print(const tamp::scene::RobotCell& cell, const TampOutcome& outcome) {
  if (!outcome.plan) {
    const bool none = outcome.kind == model::OutcomeKind::Infeasible;
    std::fprintf(stderr, "%s: %s\n", none ? "no plan exists" : "no plan was found", outcome.reason.c_str());
    return;
  }
  for (const tamp::scene::PlannedAction& each : outcome.plan->actions)
    std::printf("%s\n", text_of(cell, each.what).c_str());
  const tamp::planner::TampFigures& figures = outcome.figures;
  std::printf("; %s; planned in %.2f ms, certified in %.2f ms; %s, %llu failed\n",
              result::counted(outcome.plan->actions.size(), "action", "actions").c_str(), figures.plan_ms,
              figures.certify_ms,
              result::counted(figures.configurations, "configuration", "configurations").c_str(),
              static_cast<unsigned long long>(figures.failed));
  std::fflush(stdout);  // before what --json writes, which may go the same way
}

// A cell's task in one of the two languages.
struct TaskOfCell {
  lisp::Source domain, problem;
  std::optional<htn::PlanningTask> tasks;      // HDDL
  std::optional<pddl::OutsideTask> skeletons;  // PDDL
};

result::Result<TaskOfCell> read_task_of(const tamp::scene::CellFile& file) {
  auto domain = files::read_file(file.domain.string()), problem = files::read_file(file.problem.string());
  if (!domain) return result::forward(domain);
  if (!problem) return result::forward(problem);
  TaskOfCell task{{file.domain.string(), *domain}, {file.problem.string(), *problem}, {}, {}};
  if (file.problem.extension() == ".pddl") {
    auto read = tamp::planner::read_skeletons(task.domain, task.problem);
    if (!read) return result::forward(read);
    if (!read->task.warnings().empty()) (void)fail(read->task.warnings());
    if (auto known = tamp::planner::check_names(*read, file.cell, task.domain, task.problem); !known)
      return result::forward(known);
    task.skeletons = *std::move(read);
    return task;
  }
  auto read = htn::read_task(task.domain, task.problem, tamp::predicates::geometric_predicates());
  if (!read) return result::forward(read);
  if (!read->warnings.empty()) (void)fail(read->warnings);
  if (auto known = tamp::predicates::check_names(read->task, file.cell, task.domain, task.problem); !known)
    return result::forward(known);
  task.tasks = std::move(read->task);
  return task;
}

// What the task's own validator says; empty: nothing is wrong.
std::string wrong_with_tasks(const TampOutcome& outcome, const TaskOfCell& task) {
  if (task.skeletons) {
    pddl::PlanText text;
    text.actions = outcome.skeleton->actions;
    text.lines.assign(text.actions.size(), 0);
    const pddl::Validation judged = pddl::validate(task.skeletons->task, text, pddl::KeepStates::Last);
    return judged.valid ? "" : result::to_string(judged.diagnostics);
  }
  const auto& names = tamp::predicates::geometric_predicates();
  const htn::Validation judged =
      htn::validate(task.domain, task.problem, *outcome.tasks, {names.begin(), names.end()});
  return judged.valid ? "" : judged.reason;
}

// A plan that a judge refuses is a fault of this program, and nobody should drive it.
bool is_valid(const tamp::scene::RobotCell& cell, const TampOutcome& outcome, const TaskOfCell& task) {
  const std::string wrong = wrong_with_tasks(outcome, task);
  const tamp::judge::Judgement motions = tamp::judge::judge(cell, *outcome.plan);
  if (!wrong.empty()) std::fprintf(stderr, "the validator refuses the plan: %s\n", wrong.c_str());
  if (!motions.sound) std::fprintf(stderr, "the judge refuses the plan: %s\n", motions.reason.c_str());
  return wrong.empty() && motions.sound;
}

ExitCode write(const std::string& file, const std::string& text) {
  if (file.empty()) return ExitCode::Done;
  const result::Diagnostics unwritten = files::write_file(file, text);
  return unwritten.empty() ? ExitCode::Done : fail(unwritten);
}

TampOutcome search(const tamp::scene::RobotCell& cell, const TaskOfCell& task, const TampArguments& arguments,
                   double& prepare_ms) {
  using Clock = std::chrono::steady_clock;
  const process::Interruption interruption;
  tamp::planner::TampOptions options;
  using tamp::planner::Method;
  options.method = arguments.method == "paper-literal"     ? Method::PaperLiteral
                   : arguments.method == "paper-first-way" ? Method::PaperFirstWay
                   : arguments.method == "paper-from-one"  ? Method::PaperFromOne
                                                           : Method::Ours;
  options.seed = arguments.seed;
  options.most_proposals = 30;
  options.cancel = interruption.flag();
  const Clock::time_point began = Clock::now();
  std::optional<tamp::planner::IntervalModel> model;
  if (options.method == tamp::planner::Method::Ours) model.emplace(cell);
  prepare_ms = std::chrono::duration<double, std::milli>(Clock::now() - began).count();
  constexpr double kLongestS = 1e6;  // twelve days: no clock overflows
  options.until =
      began + std::chrono::microseconds(std::llround(std::min(arguments.time_s, kLongestS) * 1e6));
  if (task.skeletons) return tamp::planner::plan(cell, *task.skeletons, *model, options);
  return tamp::planner::plan(cell, *task.tasks, model ? &*model : nullptr, options);
}

}  // namespace

ExitCode run_tamp(const TampArguments& arguments) {
  for (const std::string& file : {arguments.json_file, arguments.svg_file}) {
    if (file.empty()) continue;
    if (const auto unwritable = files::check_writable(file); !unwritable.empty()) return fail(unwritable);
  }
  auto file = tamp::scene::load_cell(arguments.problem);
  if (!file) return fail(file.error());
  if (!file->warnings.empty()) (void)fail(file->warnings);
  const auto task = read_task_of(*file);
  if (!task) return fail(task.error());
  if (task->skeletons && arguments.method != "ours") {
    std::fprintf(stderr, "tasks in PDDL are planned by --method ours only\n");
    return ExitCode::Usage;
  }
  if (arguments.grasps > 0) file->cell.manner.grasps = arguments.grasps;
  if (arguments.places > 0) file->cell.manner.places = arguments.places;
  double prepare_ms = 0.0;
  TampOutcome outcome = search(file->cell, *task, arguments, prepare_ms);
  // All samples were tried, which proves nothing about what lies between them.
  if (arguments.method != "ours" && outcome.kind == model::OutcomeKind::Infeasible)
    outcome.kind = model::OutcomeKind::Exhausted;
  if (outcome.plan && !is_valid(file->cell, outcome, *task)) return ExitCode::RuntimeFault;
  if (arguments.json_file != "-" && arguments.svg_file != "-") print(file->cell, outcome);
  if (!arguments.json_file.empty()) {
    json document = figures_of(outcome, prepare_ms);
    if (outcome.plan) document["plan"] = tamp::drawing::plan_json(file->cell, *outcome.plan);
    const ExitCode written =
        write(arguments.json_file, document.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
    if (written != ExitCode::Done) return written;
  }
  if (!arguments.svg_file.empty()) {
    const tamp::scene::TampPlan none;
    const ExitCode drawn =
        write(arguments.svg_file, tamp::drawing::plan_svg(file->cell, outcome.plan ? *outcome.plan : none));
    if (drawn != ExitCode::Done) return drawn;
  }
  return exit_of(outcome.kind);
}

}  // namespace stepwright::tamp_program
