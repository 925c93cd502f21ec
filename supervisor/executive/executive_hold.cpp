// At rest for as long as an operator wants it. The program that reads the sensors keeps the outputs of the
// plan off; the clock goes on.

#include <fmt/format.h>

#include <algorithm>

#include "runtime/service/answer_codes.h"
#include "supervisor/executive/executive.h"

namespace stepwright::executive {

using std::chrono::milliseconds;

run::Cause Executive::held_by_operator() {
  return {run::IncidentKind::Operator, {"held by the operator"}, {}};
}

std::optional<run::Cause> Executive::wish() {
  return hold_ ? std::optional(held_by_operator()) : std::nullopt;
}

result::Result<void> Executive::request_hold() {
  {
    const std::lock_guard lock(requests_mutex_);
    if (stage_ == Stage::Ready)
      return result::fail(service::kNotNow, {}, "nothing runs yet that could be held",
                          "it waits for its start");
  }
  if (!hold_.exchange(true)) return {};
  return result::fail(service::kNotNow, {}, "the run is held already", "resume or abort it");
}

result::Result<void> Executive::request_resume() {
  if (hold_.exchange(false)) return {};
  return result::fail(service::kNotNow, {}, "nothing is held that could be resumed");
}

// False if the run is over. A runtime that is gone, or stopped, changes nothing here: whoever resumes has the
// plant looked at anew.
bool Executive::stay_held() {
  const double since_s = clock_.now_s();
  double now_s = clock_.now_s();  // by the newest picture: a plant at rest causes no events
  set_phase(run::Phase::Held, "held by the operator: the plant rests until the run is resumed or aborted");
  (void)controller_.acknowledge(observed_event_);
  while (hold_) {
    if (abort_) return give_up_aborted();
    if (const auto change = due(now_s)) {
      std::vector<std::string>& evidence = record_.incidents.back().evidence;
      evidence.insert(evidence.end(), change->evidence.begin(), change->evidence.end());
      set_phase(run::Phase::Held,
                change->evidence.back() +
                    ": that is planned for when the run is resumed; until then the plant rests");
    }
    if (const auto event = controller_.wait_event(milliseconds(200))) {
      note_while_held(*event);
      (void)controller_.acknowledge(event->sequence);
    }
    const auto snapshot = controller_.snapshot();
    if (snapshot && snapshot->program_digest == digest_)
      now_s = std::max(now_s, clock_.at(snapshot->incarnation, snapshot->time_ns));
  }
  record_.incidents.back().evidence.push_back(fmt::format("resumed after {:.1f} s", now_s - since_s));
  set_phase(run::Phase::Replanning, "resumed by the operator");
  return true;
}

void Executive::note_while_held(const host::StepEvent& event) {
  const bool ended = event.kind == host::EventKind::Trap || event.kind == host::EventKind::Stopped ||
                     event.kind == host::EventKind::RolledBack;
  if (!ended || event.program_digest != digest_) return;
  record_.incidents.back().evidence.push_back("the runtime stopped meanwhile: " + event.detail);
  publish(/*now=*/true);
}

}  // namespace stepwright::executive
