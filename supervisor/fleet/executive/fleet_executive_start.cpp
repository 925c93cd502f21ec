// The first plan: made, shown where an operator starts runs, and begun.

#include <fmt/format.h>

#include <utility>

#include "supervisor/fleet/executive/fleet_executive.h"

namespace stepwright::fleet {

using run::IncidentKind;
using run::Phase;
using run::Response;
using std::chrono::milliseconds;

namespace {

constexpr milliseconds kLookAtRequests{50};

}  // namespace

bool FleetExecutive::start_afresh() {
  while (true) {
    FleetRequest request{.rest = {.starts = desk_.first_starts()}, .cancel = &abort_};
    for (const Blocked& place : blocked_) request.blocked.push_back(place.area);
    request.revision = ++revision_;
    auto outcome = desk_.plan(ledger_, request);
    if (!outcome) return give_up(result::to_string(outcome.error()), IncidentKind::ProgramFault);
    if (!outcome->prepared.program) return give_up_planless(*outcome);
    const Wish wish = wanted() ? Wish::Start : stay_ready(*outcome, request);
    if (wish == Wish::Abort) return false;
    if (wish == Wish::OtherPlan) continue;
    enter(Stage::Running);
    return await_runtime() && launch(*std::move(outcome), request);
  }
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
  enter(Stage::Ready);
  set_phase(Phase::Ready,
            fmt::format("a plan of {} stops is ready: nothing moves until an operator starts it",
                        record_.episodes.back().actions.size()));
  while (true) {
    if (abort_) {
      give_up_aborted();
      return Wish::Abort;
    }
    const bool started = await_start(kLookAtRequests);
    const auto cause = due(clock_.now_s());
    if (!started && !cause) {
      publish(false);
      continue;
    }
    record_.episodes.clear();
    if (cause) {
      open_incident(*cause);
      decide(Response::Replan);
    }
    set_phase(Phase::Planning, cause ? cause->evidence.front() : "started by the operator");
    return cause ? Wish::OtherPlan : Wish::Start;
  }
}

result::Result<void> FleetExecutive::request_start() {
  const auto refuse = [](const char* why, const char* hint) { return result::fail("X0008", {}, why, hint); };
  if (!controller_.alive())
    return refuse("no runtime answers: the fleet would begin to move whenever one comes",
                  "start the runtime first");
  const std::lock_guard lock(requests_mutex_);
  if (stage_ != Stage::Ready || start_) return refuse("the run is under way", "hold or abort it");
  if (abort_) return refuse("the run is being aborted", "start the supervisor again for another one");
  start_ = true;
  start_signal_.notify_all();
  return {};
}

bool FleetExecutive::wanted() const {
  const std::lock_guard lock(requests_mutex_);
  return !options_.operator_starts || start_;
}

}  // namespace stepwright::fleet
