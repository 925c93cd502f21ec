#pragma once

// From the variables of a running program to a named state, and what in it is not as expected.
//
// Pure functions; use from any thread.
//
//   Estimate now = estimate(binding, values, tare, expected_state(translation, done), in_progress);
//   for (const std::string& sentence : deviations(binding, expected, now.measured)) report(sentence);

#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/model/planned_run.h"
#include "supervisor/translate/binding.h"
#include "supervisor/translate/translation.h"

namespace stepwright::translate {

// Variable -> value: every tag of a fact (0 or 1) and `filtered_variable` of every sensor; of a program that
// averages `half_variable` too.
using Values = std::map<std::string, double>;

struct Estimate {
  model::NamedState measured;  // sensors as calibrated, the rest as tracked
  model::NamedState planning;  // the same in multiples of each sensor's resolution: what a planner starts
                               // from; amounts are kept, so what left a tank has arrived
  std::vector<std::string> contradictions;  // e.g. a vehicle at two places; sentences for people
};

// `tracked` is the state expected after the completed actions; `in_progress` are those that have begun and
// not ended: their transfers count as far as the sensors show. For the planner the fluents in `away` are
// rounded to the other neighbour instead of the nearest: what is left to the next multiple is then something
// to plan for. Fails with T0010 if a value is missing.
[[nodiscard]] result::Result<Estimate> estimate(const Binding& binding, const Values& values,
                                                const Tare& tare, const model::NamedState& tracked,
                                                std::span<const model::GroundAction> in_progress = {},
                                                const std::set<std::string>& away = {});

// An observed fluent outside its tolerance, or an observed fact that is not as expected.
struct Difference {
  std::string atom;  // "(level a1)", "(is-at v1 f1)"
  std::string label;
  bool is_fact = false;
  double expected = 0.0;  // facts: 0 or 1
  double measured = 0.0;
  double tolerance = 0.0;
};

// Atoms in `ignored` (see changed_atoms: what running actions change) are not compared.
std::vector<Difference> differences(const Binding& binding, const model::NamedState& expected,
                                    const model::NamedState& measured,
                                    const std::set<std::string>& ignored = {});
std::string to_string(const Difference& difference);

// The differences as sentences such as "level of a1 is 3.9, expected 5.0 (tolerance 0.2)".
std::vector<std::string> deviations(const Binding& binding, const model::NamedState& expected,
                                    const model::NamedState& measured,
                                    const std::set<std::string>& ignored = {});

// Levels that moved by more than their tolerance from one half of the window of averaging to the other, as
// sentences such as "level of a1 moves: 2.0, then 1.2". Fails with T0010 if a value is missing.
[[nodiscard]] result::Result<std::vector<std::string>> movements(const Binding& binding, const Values& means);

// Bias of each sensor that the binding has tared = mean counts - calibration at the known level. The others
// are believed: where they show something else than the problem says, the plant is there. Fails with T0010 if
// a value or level is missing and with T0011 if a bias is larger than the binding allows.
[[nodiscard]] result::Result<Tare> identify_tare(const Binding& binding, const Values& means,
                                                 const model::NamedState& known);

}  // namespace stepwright::translate
