#include "supervisor/executive/what_if.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "runtime/ground/result/last_barrier.h"
#include "runtime/service/answer_codes.h"
#include "supervisor/run/internal/record_json.h"

namespace stepwright::executive {
namespace {

using run::internal::json;

// Of the thread that searches; whatever plans for the plant comes first.
constexpr int kNice = 10;

json beginning_of(const WhatIfQuestion& question, const char* state) {
  return {{"id", question.id}, {"goal", question.goal}, {"state", state}, {"ahead", question.outlook.ahead}};
}

json worth_json(const PlanWorth& worth, std::size_t steps) {
  return {{"steps", steps},
          {"cost", worth.cost},
          {"cost_ahead", worth.cost - worth.cost_before},
          {"makespan_s", worth.makespan_s}};
}

json plan_json(const run::Episode& episode, double cost_before) {
  json actions = json::array();
  const std::size_t listed = std::min(episode.actions.size(), kMostListedActions);
  for (std::size_t i = 0; i < listed; ++i) {
    const run::ActionRecord& action = episode.actions[i];
    actions.push_back({{"index", i},
                       {"text", action.text},
                       {"planned_start_s", action.planned_start_s},
                       {"planned_finish_s", action.planned_finish_s},
                       {"planned_cost", action.planned_cost}});
  }
  json plan = worth_json({episode.cost, cost_before, episode.planned_makespan_s}, episode.actions.size());
  plan["bound"] = episode.bound ? json(*episode.bound) : json(nullptr);
  plan["proved_optimal"] = episode.proved_optimal;
  plan["first_plan_ms"] = episode.first_plan_ms;
  plan["sequential_makespan_s"] = episode.planned_sequential_makespan_s;
  plan["actions"] = std::move(actions);
  return plan;
}

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

WhatIf::WhatIf(const PlanningService& service, const WhatIfOptions& options)
    : service_(service), options_(options) {}

WhatIf::~WhatIf() {
  cancel_ = true;
  if (thread_.joinable()) thread_.join();
}

result::Result<void> WhatIf::ask(WhatIfQuestion question) {
  if (question.id.size() > kMaxWhatIfId)
    return result::fail("X0005", {}, "the id of the question is too long",
                        "up to " + std::to_string(kMaxWhatIfId) + " bytes are possible");
  const std::lock_guard turn(turn_);
  if (planning_) {
    return result::fail(service::kNotNow, {}, "another what-if is being planned",
                        "wait for it, or cancel it");
  }
  if (question.goal.empty()) question.goal = service_.goal_text(question.outlook.goal);
  if (auto checked = service_.check_goal(question.goal); !checked) return checked;
  if (thread_.joinable()) thread_.join();  // it has said its last word
  cancel_ = false;
  planning_ = true;
  publish(run::internal::text_of(beginning_of(question, "planning")));
  {
    const std::lock_guard lock(mutex_);
    id_ = question.id;
  }
  thread_ = std::thread([this, question = std::move(question)] {
    ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNice);  // of this thread alone
    // A question that is too much for this machine ends as a question, not as the run.
    if (const auto thrown = result::thrown_by([&] { plan(question); })) {
      json told = beginning_of(question, "failed");
      told["reason"] = *thrown;
      publish(run::internal::text_of(told));
    }
    planning_ = false;
  });
  return {};
}

result::Result<void> WhatIf::cancel(const std::string& id) {
  const std::lock_guard turn(turn_);
  const std::lock_guard lock(mutex_);
  if (!planning_ || (!id.empty() && id != id_))
    return result::fail(service::kNotNow, {}, "no such what-if is being planned", "it may have just ended");
  cancel_ = true;
  return {};
}

std::string WhatIf::answer() const {
  const std::lock_guard lock(mutex_);
  return answer_;
}

std::uint64_t WhatIf::revision() const {
  const std::lock_guard lock(mutex_);
  return revision_;
}

void WhatIf::publish(std::string answer) {
  const std::lock_guard lock(mutex_);
  answer_ = std::move(answer);
  ++revision_;
}

void WhatIf::plan(const WhatIfQuestion& question) {
  const auto began = std::chrono::steady_clock::now();
  const Outlook& outlook = question.outlook;
  const StartState start{.planning = outlook.state, .goal = question.goal};
  const auto outcome = service_.sketch({.start = start,
                                        .without = outlook.without,
                                        .budget = {options_.time, options_.memory_mb},
                                        .cancel = &cancel_});
  json told = beginning_of(question, outcome ? state_of(outcome->status) : "failed");
  told["wall_ms"] =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
  if (!outcome) told["reason"] = result::to_string(outcome.error());
  if (outcome && outcome->status != PrepareStatus::Ready) told["reason"] = reason_of(*outcome);
  if (outcome && outcome->status == PrepareStatus::Ready) {
    const auto here = service_.worth_of(start, {});
    told["plan"] = plan_json(outcome->prepared.episode, here ? here->cost_before : 0.0);
  }
  const auto running =
      service_.worth_of({.planning = outlook.state, .goal = outlook.goal}, outlook.remaining);
  const bool comparable = running && !outlook.remaining.empty();
  told["running"] = comparable ? worth_json(*running, outlook.remaining.size()) : json(nullptr);
  publish(run::internal::text_of(told));
}

}  // namespace stepwright::executive
