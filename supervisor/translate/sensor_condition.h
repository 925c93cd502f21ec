#pragma once

// Statements about facts and levels as conditions on the controller's variables: a fact is a contact of its
// switch, a level a comparison of filtered raw counts, as in the paper's Table 4 ("until D100 > 3783"), with
// the tare of the sensor added to the calibrated threshold.
//
// Pure functions; use from any thread.

#include <map>
#include <optional>
#include <string>

#include "ladder/graphic/condition.h"
#include "supervisor/translate/binding.h"

namespace stepwright::translate {

// Bias of each sensor in raw counts, by the sensor's name; a sensor that is not listed has none.
using Tare = std::map<std::string, double>;

double tare_of(const Tare& tare, const Sensor& sensor);

// Filtered counts at a value, rounded and limited to the range of `type` ("INT" or "UINT").
struct Threshold {
  long counts = 0;
  bool limited = false;  // the type cannot hold it
};
Threshold threshold(const Sensor& sensor, const std::string& type, const Tare& tare, double value);

// "The measured value is at least (at most) `value`."
graphic::Condition at_least(const Sensor& sensor, const std::string& type, const Tare& tare, double value);
graphic::Condition at_most(const Sensor& sensor, const std::string& type, const Tare& tare, double value);
// "... within `tolerance` of `value`."
graphic::Condition near(const Sensor& sensor, const std::string& type, const Tare& tare, double value,
                        double tolerance);
// "The fact is observed as `expected`."
graphic::Condition fact_is(const ObservedFact& fact, bool expected);

// `condition` without the parts that are also parts of `known`: what is left to check where `known` holds.
graphic::Condition without(const graphic::Condition& condition, const graphic::Condition& known);

// The opposite, by De Morgan. Nullopt for True, whose opposite never holds. Requires contacts without edges.
std::optional<graphic::Condition> inverse(const graphic::Condition& condition);

}  // namespace stepwright::translate
