#pragma once

// Everything the chart needs to know about one action of the plan: which outputs it drives, when it is done,
// when it may start and when it must be stopped, all as conditions on the controller's variables.

#include <optional>
#include <string>
#include <vector>

#include "supervisor/translate/change.h"
#include "supervisor/translate/guard.h"
#include "supervisor/translate/sensor_condition.h"

namespace stepwright::translate {

// Outputs that do nothing: what is observed then still, long enough after they were switched on.
struct Idle {
  milliseconds after{0};
  graphic::Condition condition;
};

struct ActionConditions {
  const ActionBinding* entry = nullptr;
  graphic::Condition complete;
  std::string complete_text;  // for people: "level of v1 reaches 10"
  Guard guard;
  std::vector<graphic::Condition> hold;  // each must stay true while the outputs are on
  std::optional<Idle> idle;              // nothing if its durations do not tell when
};

// `offsets` as before the action (ExpectedChanges::before); the binding outlives the result. Fails with
// T0001, T0003 to T0005 as `translate`.
[[nodiscard]] result::Result<ActionConditions> action_conditions(const model::PlannedAction& planned,
                                                                 const Binding& binding, const Tare& tare,
                                                                 const Offsets& offsets);

// The initial snapshot as far as it can be measured: facts as given, levels within tolerance.
graphic::Condition snapshot_condition(const model::NamedState& state, const Binding& binding,
                                      const Tare& tare);

}  // namespace stepwright::translate
