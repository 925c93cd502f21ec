#pragma once

// A ground precondition as the controller can observe it: facts by their switches, comparisons by filtered
// counts within the sensors' tolerance. What no sensor sees (a client's demand) stands at its value in the
// plan and is listed as assumed.
//
// A comparison over one measured fluent becomes a comparison of counts; over several a REAL expression of
// calibrated levels, for which the program must compute `value_variable` of the sensors in `values`. A
// comparison that is not linear in measured fluents is assumed.

#include <map>
#include <set>
#include <string>
#include <vector>

#include "ladder/graphic/condition.h"
#include "runtime/ground/result/result.h"
#include "supervisor/model/planned_run.h"
#include "supervisor/translate/sensor_condition.h"

namespace stepwright::translate {

// Measured minus planned value of fluents; a fluent that is not listed has 0.
using Offsets = std::map<std::string, double>;

struct Guard {
  graphic::Condition condition;      // True if nothing can be checked
  std::vector<std::string> assumed;  // PDDL text of the parts that are not checked
  std::set<std::string> values;      // sensors whose calibrated level the condition reads
};

// Each of the `offsets` widens the tolerance of its sensor, because the plan was made for the rounded value.
// Fails with T0005 if the precondition does not hold in `before`, the state in which the plan has the action.
[[nodiscard]] result::Result<Guard> make_guard(const model::PlannedAction& planned, const Binding& binding,
                                               const Tare& tare, const Offsets& offsets);

// "S1_value": the calibrated level as REAL.
std::string value_variable(const Sensor& sensor);
// A REAL literal: "3.5", "-2.0", "1.0e-07".
std::string real_literal(double value);

}  // namespace stepwright::translate
