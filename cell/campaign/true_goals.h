#pragma once

// Whether a plant is where a report says: the goals over quantities that the binding has a sensor for, judged
// by the plant's true state and not by what the sensor shows.
//
// Thread rule: one thread at a time; the plant and the controller belong to it.

#include <optional>
#include <string>
#include <vector>

#include "cell/simulation/simulated_controller.h"
#include "plant_models/bridge/plant_driver.h"
#include "supervisor/run/run_record.h"
#include "supervisor/translate/binding.h"

namespace stepwright::campaign {

// Empty if every goal that can be judged holds, else what does not: "(= (level a1) 5): it is 4.21 in the
// plant". `faulty`: a sensor had a fault, and its binding allows so much of that to stay unseen.
std::string wrong_goal(const run::RunRecord& record, const translate::Binding& binding,
                       const std::vector<bridge::PortWire>& wires, const core::Plant& plant, bool faulty);

// What the sensor would show of the plant's true state, in units of its fluent; nothing if the plant does not
// say what the terminal measures.
std::optional<double> true_value(const translate::Sensor& sensor, const translate::Binding& binding,
                                 const std::vector<bridge::PortWire>& wires, const core::Plant& plant);

}  // namespace stepwright::campaign
