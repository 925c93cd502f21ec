#include "programs/htn/htn_command.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "runtime/ground/files/files.h"
#include "runtime/ground/process/interruption.h"
#include "runtime/ground/result/counted.h"
#include "supervisor/htn/plan/plan_json.h"
#include "supervisor/htn/plan/validate.h"
#include "supervisor/htn/search/search.h"
#include "supervisor/htn/task/read_task.h"
#include "supervisor/model/outcome_name.h"

namespace stepwright::htn_program {

namespace {

using nlohmann::json;
using result::ExitCode;

struct Answer {
  htn::SearchOutcome outcome;
  htn::SearchStatistics statistics;
  double wall_ms = 0.0;
};

ExitCode fail(const result::Diagnostics& diagnostics) {
  std::fprintf(stderr, "%s\n", result::to_string(diagnostics).c_str());
  return ExitCode::BadInput;
}

Answer search(const htn::PlanningTask& task, double time_s) {
  const process::Interruption interruption;
  const auto began = std::chrono::steady_clock::now();
  constexpr double kLongestS = 1e6;  // twelve days: no clock overflows
  const std::chrono::microseconds time(std::llround(std::min(time_s, kLongestS) * 1e6));
  htn::SearchOptions options;
  options.until = began + time;
  options.cancel = interruption.flag();
  htn::Search search(task, options);
  Answer answer{search.next(), {}, 0.0};
  answer.wall_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
  answer.statistics = search.statistics();
  return answer;
}

json json_of(const Answer& answer) {
  const htn::SearchStatistics& statistics = answer.statistics;
  json document = {{"outcome", name_of(answer.outcome.kind)},
                   {"reason", answer.outcome.reason},
                   {"plan", json::array()},
                   {"plan_steps", nullptr},
                   {"plan_cost", nullptr},
                   {"wall_ms", answer.wall_ms},
                   {"decompositions", statistics.decompositions},
                   {"actions", statistics.actions},
                   {"dead_ends", statistics.dead_ends},
                   {"known_nodes", statistics.known_nodes},
                   {"loops", statistics.loops},
                   {"stages", statistics.stages}};
  if (answer.outcome.plan) document.update(htn::to_json(*answer.outcome.plan));
  return document;
}

void print(const Answer& answer) {
  if (!answer.outcome.plan) {
    const bool none = answer.outcome.kind == model::OutcomeKind::Infeasible;
    std::fprintf(stderr, "%s: %s\n", none ? "no plan exists" : "no plan was found",
                 answer.outcome.reason.c_str());
    return;
  }
  const htn::Plan& plan = *answer.outcome.plan;
  for (const std::size_t step : plan.steps) std::printf("%s\n", to_string(plan.nodes[step]).c_str());
  std::printf("; %s, cost %.12g; found in %.2f ms, %s, %s applied\n",
              result::counted(plan.steps.size(), "step", "steps").c_str(), plan.cost, answer.wall_ms,
              result::counted(answer.statistics.decompositions, "decomposition", "decompositions").c_str(),
              result::counted(answer.statistics.actions, "action", "actions").c_str());
  std::fflush(stdout);  // before what --json writes, which may go the same way
}

ExitCode write(const std::string& file, const std::string& text) {
  const result::Diagnostics unwritten = files::write_file(file, text);
  return unwritten.empty() ? ExitCode::Done : fail(unwritten);
}

// A plan that the validator refuses is a fault of this program, and nobody should drive it.
bool is_valid(const lisp::Source& domain, const lisp::Source& problem, const htn::Plan& plan,
              const HtnArguments& arguments) {
  const std::set<std::string> external(arguments.external.begin(), arguments.external.end());
  const htn::Validation judged = htn::validate(domain, problem, plan, external);
  if (!judged.valid) std::fprintf(stderr, "the validator refuses the plan: %s\n", judged.reason.c_str());
  return judged.valid;
}

}  // namespace

ExitCode run_htn(const HtnArguments& arguments) {
  for (const std::string& file : {arguments.json_file, arguments.out_file}) {
    if (file.empty()) continue;
    if (const auto unwritable = files::check_writable(file); !unwritable.empty()) return fail(unwritable);
  }
  const auto domain_text = files::read_file(arguments.domain);
  if (!domain_text) return fail(domain_text.error());
  const auto problem_text = files::read_file(arguments.problem);
  if (!problem_text) return fail(problem_text.error());
  const lisp::Source domain{arguments.domain, *domain_text}, problem{arguments.problem, *problem_text};
  const auto read = htn::read_task(domain, problem, arguments.external);
  if (!read) return fail(read.error());
  if (!read->warnings.empty()) (void)fail(read->warnings);
  const Answer answer = search(read->task, arguments.time_s);
  if (answer.outcome.plan && !is_valid(domain, problem, *answer.outcome.plan, arguments))
    return ExitCode::RuntimeFault;
  if (arguments.json_file != "-") print(answer);
  if (!arguments.json_file.empty()) {
    const std::string text = json_of(answer).dump(1, ' ', false, json::error_handler_t::replace) + "\n";
    if (const ExitCode written = write(arguments.json_file, text); written != ExitCode::Done) return written;
  }
  if (!arguments.out_file.empty() && answer.outcome.plan) {
    const ExitCode written = write(arguments.out_file, htn::print_plan(*answer.outcome.plan));
    if (written != ExitCode::Done) return written;
  }
  return exit_of(answer.outcome.kind);
}

}  // namespace stepwright::htn_program
