#include "tests/fuzz/htn/htn_run.h"

#include <algorithm>

#include "supervisor/htn/plan/validate.h"
#include "supervisor/htn/search/search.h"
#include "supervisor/htn/task/read_task.h"

namespace stepwright::fuzz::htn {
namespace {

using namespace stepwright::htn;

// Everything is bounded here: variables multiply, and a random text may have many.
constexpr std::size_t kMostParameters = 4;
constexpr std::size_t kMostObjects = 12;
constexpr int kMostVariables = 60;
constexpr std::size_t kMostNodes = 200;
constexpr int kMostPending = 40;

int nested(const Condition& condition) {
  int most = 0;
  for (const Condition& part : condition.parts) most = std::max(most, nested(part));
  return most + static_cast<int>(condition.variables.size());
}

bool small(const PlanningTask& task, std::string_view input) {
  const auto few = [](const auto& schema) {
    return schema.parameters.size() <= kMostParameters && nested(schema.condition) <= 2;
  };
  const auto tame = [](const Action& action) {
    return std::ranges::all_of(action.effects, [](const Effect& effect) {
      return effect.variables.size() + static_cast<std::size_t>(nested(effect.condition)) <= 2;
    });
  };
  return task.objects.size() <= kMostObjects && std::ranges::count(input, '?') <= 4 * kMostVariables &&
         std::ranges::all_of(task.methods, few) && std::ranges::all_of(task.actions, few) &&
         std::ranges::all_of(task.actions, tame) && nested(task.goal) <= 2;
}

std::string check_diagnostics(const result::Diagnostics& diagnostics) {
  if (diagnostics.empty()) return "refused without a diagnostic";
  for (const result::Diagnostic& d : diagnostics) {
    if (d.code.size() != 5 || d.message.empty()) return "a diagnostic without code or message";
    if (d.where.file.empty() || d.where.line == 0 || d.where.column == 0)
      return "a diagnostic without a place: " + result::to_string(d);
  }
  return {};
}

}  // namespace

Run run(std::string_view input) {
  Run run;
  const std::size_t at = input.find(";;problem\n");
  const lisp::Source domain{"domain", std::string(input.substr(0, at))};
  const lisp::Source problem{"problem", at == std::string_view::npos ? "" : std::string(input.substr(at))};
  const auto read = read_task(domain, problem);
  if (!read) {
    run.finding = check_diagnostics(read.error());
    return run;
  }
  run.parsed = true;
  if (!small(read->task, input)) return run;
  SearchOptions options;
  options.most_nodes = kMostNodes;
  options.most_pending = kMostPending;
  Search search(read->task, options);
  const SearchOutcome outcome = search.next();
  run.planned = outcome.plan.has_value();
  if (!outcome.plan) {
    if (outcome.reason.empty()) run.finding = "no plan, and no reason";
    return run;
  }
  const Validation judged = validate(domain, problem, *outcome.plan);
  if (!judged.valid) run.finding = "a plan that the validator refuses: " + judged.reason;
  return run;
}

}  // namespace stepwright::fuzz::htn
