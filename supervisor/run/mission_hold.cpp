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
      if (!runtime_lost() || (await.goes_on && has_gone_on())) continue;
      return record_.phase == Phase::Safe ? Rest::Ended : Rest::Lost;
    }
    if (event->kind == host::EventKind::RolledBack && !await.rolled_back.empty())
      return end(await.rolled_back + ": " + event->detail, IncidentKind::ProgramFault);
    const bool ours = event->program_digest == digest_;
    if (ours) clock_.see(event->incarnation, event->time_ns);
    if (ours && ends_program(event->kind))
      return end(await.stopped + ": " + event->detail, IncidentKind::ProgramFault);
    if (ours && event->kind == host::EventKind::StepChange) {
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

std::optional<double> Mission::hold_at_rest(const Hold& hold) {
  const auto end = [&](const std::string& reason, IncidentKind kind) {
    give_up(reason, kind);
    return std::nullopt;
  };
  if (hold.cause) open_incident(*hold.cause);
  const std::size_t incident = record_.incidents.size() - 1;
  set_phase(hold.phase, hold.message);
  const double since_s = clock_.now_s();
  const double until_s = since_s + static_cast<double>(hold.most.count());
  double now_s = since_s;
  while (true) {
    if (abort_) return end("aborted by the operator", IncidentKind::Operator);
    const auto event = controller_.wait_event(std::chrono::milliseconds(200));
    const bool lost = !event && !hold.stopped.empty() && runtime_lost() && !has_gone_on();
    if (lost && record_.phase == Phase::Safe) return std::nullopt;
    if (lost || (event && !see_held(*event, hold))) return end(hold.stopped, IncidentKind::LostRuntime);
    // Who rests causes no event that would tell what there is, and the time.
    const auto snapshot = controller_.snapshot();
    if (!event && hold.see && snapshot && snapshot->program_digest == digest_) hold.see(snapshot->image);
    if (!event) now_s = shown_time(snapshot, now_s);
    now_s = std::max(now_s, clock_.now_s());
    const auto asked = due(now_s);  // that is in the next plan
    if (asked && hold.asked) hold.asked(*asked);
    publish(false);  // nobody who stands causes news
    if (!hold.holds()) {
      if (hold.cause) record_.incidents[incident].response = Response::Replan;
      return now_s - since_s;
    }
    if (now_s > until_s) return end(hold.left, record_.incidents[incident].kind);
    if (event) (void)controller_.acknowledge(event->sequence);
  }
}

// False if that ends the hold: the program does not run any more.
bool Mission::see_held(const host::StepEvent& event, const Hold& hold) {
  const bool ours = event.program_digest == digest_;
  if (hold.stopped.empty() && ours && ends_program(event.kind)) return note_stopped(event);
  if (event.kind == host::EventKind::RolledBack) return hold.stopped.empty();
  if (!ours) return true;
  if (ends_program(event.kind)) return false;
  clock_.see(event.incarnation, event.time_ns);
  if (hold.see && event.kind == host::EventKind::StepChange) hold.see(event.image);
  publish(false);
  return true;
}

bool Mission::note_stopped(const host::StepEvent& event) {
  record_.incidents.back().evidence.push_back("the runtime stopped meanwhile: " + event.detail);
  publish(/*now=*/true);
  return true;
}

}  // namespace stepwright::run
