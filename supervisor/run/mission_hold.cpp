// A plant that comes to rest, and one that is held there.

#include <algorithm>
#include <chrono>

#include "supervisor/run/mission.h"

namespace stepwright::run {

Mission::Rest Mission::await_rest(const Await& await) {
  const double until_s = clock_.now_s() + await.within_s;
  const auto end = [&](const std::string& reason, IncidentKind kind) {
    give_up(reason, kind);
    return Rest::Ended;
  };
  while (true) {
    if (abort_) return end("aborted by the operator", IncidentKind::Operator);
    const auto event = controller_.wait_event(std::chrono::milliseconds(200));
    if (!event) {
      if (!runtime_lost() || has_gone_on()) continue;
      return record_.phase == Phase::Safe ? Rest::Ended : Rest::Lost;
    }
    const bool ours = event->program_digest == digest_;
    if (ours && ends_program(event->kind))
      return end(await.stopped + ": " + event->detail, IncidentKind::ProgramFault);
    if (ours && event->kind == host::EventKind::StepChange) {
      clock_.see(event->incarnation, event->time_ns);
      const auto rest = await.see(event->image);
      rested_at_ = event->sequence;
      if (rest == Rest::Reached) return *rest;
      if (rest || clock_.now_s() > until_s) {
        (void)controller_.acknowledge(event->sequence);
        return rest ? *rest : end(await.late, await.late_kind);
      }
    }
    (void)controller_.acknowledge(event->sequence);
  }
}

bool Mission::hold_at_rest(const Hold& hold) {
  open_incident(hold.cause);
  const std::size_t incident = record_.incidents.size() - 1;
  set_phase(hold.phase, hold.message);
  const double until_s = clock_.now_s() + static_cast<double>(hold.most.count());
  double now_s = clock_.now_s();
  while (true) {
    if (abort_) return give_up_aborted();
    const auto event = controller_.wait_event(std::chrono::milliseconds(200));
    if (event ? !see_held(*event, hold) : runtime_lost() && !has_gone_on())
      return record_.phase != Phase::Safe && give_up(hold.stopped, IncidentKind::LostRuntime);
    // Who rests causes no event that would tell what there is, and the time.
    const auto snapshot = controller_.snapshot();
    if (!event && snapshot && snapshot->program_digest == digest_) hold.see(snapshot->image);
    if (!event) now_s = shown_time(snapshot, now_s);
    now_s = std::max(now_s, clock_.now_s());
    (void)due(now_s);  // what they ask for is in the next plan
    publish(false);    // nobody who stands causes news
    if (!hold.holds()) {
      record_.incidents[incident].response = Response::Replan;
      return true;
    }
    if (now_s > until_s) return give_up(hold.left, hold.cause.kind);
    if (event) (void)controller_.acknowledge(event->sequence);
  }
}

// False if the program does not run any more.
bool Mission::see_held(const host::StepEvent& event, const Hold& hold) {
  if (event.kind == host::EventKind::RolledBack) return false;
  if (event.program_digest != digest_) return true;
  if (ends_program(event.kind)) return false;
  clock_.see(event.incarnation, event.time_ns);
  if (event.kind == host::EventKind::StepChange) hold.see(event.image);
  publish(false);
  return true;
}

}  // namespace stepwright::run
