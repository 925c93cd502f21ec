// The first plan: made, shown where an operator starts runs, and begun.

#include <fmt/format.h>

#include <utility>

#include "runtime/service/answer_codes.h"
#include "supervisor/fleet/executive/fleet_executive.h"

namespace stepwright::fleet {

using run::IncidentKind;
using run::Phase;
using run::Response;

// What people have asked for and what cannot be planned is no end while an operator is waited for: orders are
// refused, and a place that is blocked stays so.
bool FleetExecutive::start_afresh() {
  std::optional<LedgerState> planned;  // what the plan that was shown last was made for
  while (true) {
    FleetRequest request{.rest = {.starts = planning_.first_starts()}, .cancel = &abort_};
    for (const Blocked& place : blocked_) request.blocked.push_back(place.area);
    request.revision = ++revision_;
    auto outcome = planning_.plan(ledger_, request);
    if (abort_) return give_up_aborted();
    Wish wish = Wish::OtherPlan;
    if (outcome && outcome->prepared.program) {
      planned = ledger_.state();
      ordered_ = false;
      decide(Response::Replan);
      wish = !options_.operator_starts || start_wanted() ? Wish::Start : stay_ready(*outcome, request);
    } else {
      const std::string reason = outcome ? outcome->reason : result::to_string(outcome.error());
      const bool asked = !blocked_.empty() || ledger_.ordered();
      if (planned && ordered_) {
        refuse_orders(*std::move(planned), reason);
        planned.reset();
      } else if (options_.operator_starts && asked) {
        wish = stay_planless(reason);
      } else {
        return outcome ? give_up_planless(*outcome) : give_up(reason, IncidentKind::ProgramFault);
      }
    }
    if (wish == Wish::Abort) return false;
    if (wish == Wish::OtherPlan) continue;
    begin_start();
    return await_runtime() && launch(*std::move(outcome), request);
  }
}

// All since the plan that was shown last. Whoever has wanted a start since then wanted it with them.
void FleetExecutive::refuse_orders(LedgerState planned, const std::string& reason) {
  (void)ledger_.restore(std::move(planned));  // it is the ledger's own
  ordered_ = false;
  add_evidence("what was ordered is refused, there is no plan with it: " + reason);
  decide(Response::GoOn);
  forget_start();
}

bool FleetExecutive::give_up_planless(const FleetOutcome& outcome) {
  const bool proved = outcome.prepared.answer.proof == Proof::AllPaths;
  const bool wrong = !outcome.no_way_to.empty() || !outcome.no_way_to_task.empty();
  return give_up(outcome.reason, IncidentKind::ProgramFault,
                 wrong    ? result::ExitCode::BadInput
                 : proved ? result::ExitCode::NoPlan
                          : result::ExitCode::BudgetExhausted);
}

// The plan is shown, and the runtime is not touched until an operator wants it.
FleetExecutive::Wish FleetExecutive::stay_ready(const FleetOutcome& outcome, const FleetRequest& request) {
  follow_plan(outcome, request);
  record_.episodes.clear();
  launch_record(outcome);
  return await_people(Stage::Ready,
                      fmt::format("a plan of {} stops is ready: nothing moves until an operator starts it",
                                  record_.episodes.back().actions.size()));
}

// There is nothing to start, until somebody orders something else or frees a place.
FleetExecutive::Wish FleetExecutive::stay_planless(const std::string& reason) {
  enter(Stage::Planless);  // the document has no plan from here on
  const std::string message = "there is no plan, and nothing can be started: " + reason;
  open_incident({IncidentKind::Position, {message}, {}});
  decide(Response::GoOn);
  return await_people(Stage::Planless, message);
}

FleetExecutive::Wish FleetExecutive::await_people(Stage stage, const std::string& message) {
  std::optional<run::Cause> cause;
  const Wish wish = await_wish(stage, message, cause);
  if (wish == Wish::Abort) return wish;
  record_.episodes.clear();
  if (cause) open_incident(*cause);
  set_phase(Phase::Planning, cause ? cause->evidence.front() : "started by the operator");
  return wish;
}

}  // namespace stepwright::fleet
