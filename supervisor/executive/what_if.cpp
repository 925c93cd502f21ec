#include "supervisor/executive/what_if.h"

#include <utility>

#include "supervisor/run/internal/what_if_json.h"

namespace stepwright::executive {
namespace {

using run::internal::json;

const char* state_of(PrepareStatus status) {
  switch (status) {
    case PrepareStatus::Ready:
      return "planned";
    case PrepareStatus::Infeasible:
      return "no_plan";
    case PrepareStatus::Exhausted:
      return "exhausted";
    case PrepareStatus::Cancelled:
      break;
  }
  return "cancelled";
}

std::string reason_of(const PrepareOutcome& outcome) {
  if (outcome.status == PrepareStatus::Cancelled) return "cancelled";
  if (outcome.status == PrepareStatus::Exhausted && outcome.reason.empty())
    return "the budget of time or memory ended before there was a plan";
  return outcome.reason;
}

}  // namespace

result::Result<void> WhatIf::ask(WhatIfQuestion question) {
  if (question.goal.empty()) question.goal = service_.goal_text(question.outlook.goal);
  if (auto checked = service_.check_goal(question.goal); !checked) return checked;
  const run::WhatIfAsked asked{question.id, question.goal, question.outlook.ahead};
  return thread_.ask(asked, [this, question = std::move(question)](const std::atomic<bool>& cancel) {
    return plan(question, cancel);
  });
}

std::string WhatIf::plan(const WhatIfQuestion& question, const std::atomic<bool>& cancel) const {
  const Outlook& outlook = question.outlook;
  const StartState start{.planning = outlook.state, .goal = question.goal};
  const auto outcome = service_.sketch({.start = start,
                                        .without = outlook.without,
                                        .budget = {options_.time, options_.memory_mb},
                                        .cancel = &cancel});
  json told = {{"state", outcome ? state_of(outcome->status) : "failed"}};
  if (!outcome) told["reason"] = result::to_string(outcome.error());
  if (outcome && outcome->status != PrepareStatus::Ready) told["reason"] = reason_of(*outcome);
  if (outcome && outcome->status == PrepareStatus::Ready) {
    const auto here = service_.worth_of(start, {});
    told["plan"] = run::internal::plan_json(outcome->prepared.episode, here ? here->cost_before : 0.0);
  }
  const auto running =
      service_.worth_of({.planning = outlook.state, .goal = outlook.goal}, outlook.remaining);
  const bool comparable = running && !outlook.remaining.empty();
  told["running"] = comparable
                        ? run::internal::worth_json({.steps = outlook.remaining.size(),
                                                     .cost = running->cost,
                                                     .cost_ahead = running->cost - running->cost_before,
                                                     .makespan_s = running->makespan_s})
                        : json(nullptr);
  return run::internal::text_of(told);
}

}  // namespace stepwright::executive
