#pragma once

// The types of the library, one function each; what they do stands in plant_models/doc/components.md.

#include "plant_models/components/component_type.h"

namespace stepwright::components::library {

// Tanks and what they are joined by.
ComponentType tank_type();
ComponentType source_type();
ComponentType sink_type();
ComponentType pipe_type();
ComponentType pump_type();
ComponentType control_valve_type();
ComponentType on_off_valve_type();
ComponentType selector_type();
ComponentType heater_type();
ComponentType cooler_type();
ComponentType heat_exchanger_type();
ComponentType closed_tank_type();
ComponentType three_way_valve_type();
ComponentType mixer_type();

// Sensors and cards.
ComponentType level_sensor_type();
ComponentType temperature_sensor_type();
ComponentType flow_sensor_type();
ComponentType pressure_sensor_type();
ComponentType analog_input_type();
ComponentType analog_output_type();
ComponentType position_switch_type();

// What moves.
ComponentType carriage_type();
ComponentType motor_type();
ComponentType conveyor_type();
ComponentType photo_eye_type();
ComponentType cylinder_type();
ComponentType axis_type();

// An operator's panel.
ComponentType push_button_type();
ComponentType lamp_type();

// What others have modelled.
ComponentType fmu_type();

// Plants that controllers are tuned on.
ComponentType first_order_type();
ComponentType double_tank_type();
ComponentType pendulum_type();

}  // namespace stepwright::components::library
