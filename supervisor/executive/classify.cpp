#include "supervisor/executive/classify.h"

#include <algorithm>
#include <cmath>

namespace stepwright::executive {
namespace {

using Reason = FailedAction::Reason;
using translate::Difference;

class Classifier {
 public:
  explicit Classifier(const Situation& now) : now_(now) {}

  std::optional<run::Cause> run() {
    for (const FailedAction& failed : now_.failed) cause_.evidence.push_back(failed.sentence);
    for (const Difference& difference : now_.differences) cause_.evidence.push_back(to_string(difference));
    cause_.evidence.insert(cause_.evidence.end(), now_.contradictions.begin(), now_.contradictions.end());
    if (!now_.failed.empty()) cause_.action = now_.failed.front().text;
    note_devices();
    note_signature();
    const bool quiet = now_.failed.empty() && now_.differences.empty() && now_.contradictions.empty();
    const bool sound = now_.limited.empty() && now_.frozen.empty() && now_.leapt.empty() && !now_.drift;
    if (quiet && sound) return std::nullopt;
    if (sensor() || actuator() || leak() || drift() || rest()) return cause_;
    return std::nullopt;
  }

 private:
  bool found(run::IncidentKind kind, std::string evidence = {}) {
    cause_.kind = kind;
    if (!evidence.empty()) cause_.evidence.push_back(std::move(evidence));
    return true;
  }

  void note_devices() {
    for (const FailedAction& failed : now_.failed) {
      if (failed.reason != Reason::NoEffect && failed.reason != Reason::Timeout) continue;
      cause_.devices.insert(cause_.devices.end(), failed.devices.begin(), failed.devices.end());
    }
  }

  // What has happened, without how much and to which action.
  void note_signature() {
    std::set<std::string> parts;
    for (const Difference& each : now_.differences)
      parts.insert(each.atom + (each.measured > each.expected ? " more" : " less"));
    for (const FailedAction& failed : now_.failed) parts.insert(failed.text);
    for (const std::string& part : parts) cause_.signature += part + "; ";
  }

  bool sensor() {
    for (const std::string& name : now_.limited) {
      return found(run::IncidentKind::FailedSensor, "sensor " + name + " stands at the end of its range");
    }
    for (const std::string& name : now_.frozen) {
      return found(run::IncidentKind::FailedSensor,
                   "sensor " + name + " shows the same counts while its level is moved");
    }
    for (const std::string& name : now_.leapt) {
      return found(run::IncidentKind::FailedSensor, "sensor " + name + " leaps: no plant changes so fast");
    }
    for (const Difference& difference : now_.differences) {
      if (difference.is_fact || !by_itself(now_, difference)) continue;
      if (difference.measured < difference.expected) continue;
      return found(run::IncidentKind::FailedSensor, difference.label + " has risen while nothing fills it");
    }
    const bool together = std::any_of(
        now_.contradictions.begin(), now_.contradictions.end(),
        [](const std::string& sentence) { return sentence.find("together") != std::string::npos; });
    return together && found(run::IncidentKind::FailedSensor);
  }

  bool actuator() {
    for (const FailedAction& failed : now_.failed) {
      if (failed.reason == Reason::NoEffect) return found(run::IncidentKind::FailedActuator);
    }
    return false;
  }

  bool leak() {
    for (const Difference& difference : now_.differences) {
      if (difference.is_fact || !by_itself(now_, difference)) continue;
      if (difference.measured > difference.expected) continue;
      const bool again = std::any_of(now_.earlier.begin(), now_.earlier.end(), [&](const Difference& each) {
        return each.atom == difference.atom && each.measured < each.expected;
      });
      if (!again) continue;
      return found(
          run::IncidentKind::Leak,
          difference.label + " has fallen by itself for the second time: a leak, or a sensor that drifts");
    }
    return false;
  }

  // A level that has left its tolerance just now is answered as such; its sum is told with the next look.
  bool drift() {
    const bool level = std::any_of(now_.differences.begin(), now_.differences.end(),
                                   [](const Difference& difference) { return !difference.is_fact; });
    if (!now_.drift || level) return false;
    return found(cause_of(*now_.drift).kind, to_string(*now_.drift));
  }

  bool rest() {
    for (const FailedAction& failed : now_.failed) {
      if (failed.reason == Reason::Timeout) return found(run::IncidentKind::Timeout);
      if (failed.reason == Reason::LostHold) return found(run::IncidentKind::Position);
    }
    if (!now_.differences.empty()) {
      const bool place = std::all_of(now_.differences.begin(), now_.differences.end(),
                                     [](const Difference& difference) { return difference.is_fact; });
      return found(place ? run::IncidentKind::Position : run::IncidentKind::Level);
    }
    if (!now_.failed.empty()) return found(run::IncidentKind::Refused);
    return !now_.contradictions.empty() && found(run::IncidentKind::Position);
  }

  const Situation& now_;
  run::Cause cause_;
};

}  // namespace

bool by_itself(const Situation& situation, const translate::Difference& difference) {
  if (situation.moving.contains(difference.atom) || situation.just_changed.contains(difference.atom))
    return false;
  const auto left = situation.left.find(difference.atom);
  return left == situation.left.end() || std::abs(difference.measured - left->second) > difference.tolerance;
}

run::Cause cause_of(const Drift& drift) {
  return {drift.amount > 0.0 ? run::IncidentKind::FailedSensor : run::IncidentKind::Leak, {to_string(drift)}};
}

std::optional<run::Cause> classify(const Situation& situation) {
  return Classifier(situation).run();
}

}  // namespace stepwright::executive
