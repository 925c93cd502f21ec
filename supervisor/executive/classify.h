#pragma once

// Classification of an incident: which of plant, sensor, actuator and plan is at odds with the others, from
// what is observed.
//
// Evidence against a sensor is a reading that liquid and vehicles cannot cause: a level that rises while
// nothing fills it, a place that is left while nothing drives, two places at once, counts at the end of their
// range. Evidence against an actuator is an output that was on without any effect. A level that falls by
// itself counts as a disturbance the first time, and as a leak or a drifting sensor the second time; one
// sensor alone cannot tell which. The same holds for a small difference that adds up over the run
// (drift_watch.h).
//
// Pure functions; use from any thread.

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "supervisor/executive/drift_watch.h"
#include "supervisor/run/cause.h"
#include "supervisor/translate/binding.h"
#include "supervisor/translate/estimate.h"

namespace stepwright::executive {

// An action that the chart left for its FAILED step.
struct FailedAction {
  enum class Reason : std::uint8_t { Refused, NoEffect, Timeout, LostHold, Unknown };
  std::string text;
  Reason reason = Reason::Unknown;
  std::string sentence;
  std::vector<std::string> lost_facts;  // LostHold
  std::vector<std::string> outputs;
  std::vector<std::string> devices;  // of the binding, that it needs
};

struct Situation {
  std::vector<translate::Difference> differences;  // of what no running action changes
  std::vector<std::string> contradictions;
  std::vector<FailedAction> failed;
  std::set<std::string> moving;                // atoms that running actions change
  std::set<std::string> just_changed;          // atoms that an action which ended just now has changed
  std::vector<std::string> limited;            // sensors whose counts stand at the end of their range
  std::vector<std::string> frozen;             // sensors that do not change while they should
  std::vector<std::string> leapt;              // sensors that have changed faster than the plant can
  std::map<std::string, double> left;          // levels as they were when the plan last let go of them
  std::vector<translate::Difference> earlier;  // differences of the incidents before
  std::optional<Drift> drift;                  // what has added up over the run
};

// Whether nothing in the plan has touched what differs, and it has moved since the plan let go of it: a level
// that a weak pump left at the edge of its tolerance has not.
bool by_itself(const Situation& situation, const translate::Difference& difference);

// A sensor that drifts; if it reads less and less, a leak is as likely.
run::Cause cause_of(const Drift& drift);

// Nothing if all is as expected.
std::optional<run::Cause> classify(const Situation& situation);

}  // namespace stepwright::executive
