#include "cell/campaign/verdict.h"

#include <algorithm>

namespace stepwright::campaign {

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::GoalReached:
      return "goal";
    case Verdict::SafeStop:
      return "safe";
    case Verdict::Lost:
      return "lost";
    case Verdict::Violated:
      return "violated";
  }
  return "";
}

std::string wrong_end(const run::RunRecord& record, const simulation::SimulatedController& controller) {
  if (controller.any_output()) return "an output is on after the end";
  const bool open = std::ranges::any_of(record.incidents, [](const run::Incident& incident) {
    return incident.response == run::Response::Open;
  });
  if (open) return "an incident was left without a decision";
  if (record.phase != run::Phase::Done && record.phase != run::Phase::Safe)
    return std::string("ended while ") + to_string(record.phase);
  return {};
}

std::string wrong_stop(const run::RunRecord& record) {
  if (record.incidents.empty()) return "given up without an incident";
  const run::Incident& last = record.incidents.back();
  if (last.response != run::Response::SafeStop) return "the last incident is not the stop";
  if (last.evidence.empty()) return "the stop has no evidence";
  return {};
}

}  // namespace stepwright::campaign
