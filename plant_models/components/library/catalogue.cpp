#include "plant_models/components/library/catalogue.h"

#include "plant_models/components/library/types.h"

namespace stepwright::components::library {

Catalogue catalogue() {
  static const std::vector<ComponentType> kTypes = {tank_type(),
                                                    source_type(),
                                                    sink_type(),
                                                    pipe_type(),
                                                    pump_type(),
                                                    control_valve_type(),
                                                    on_off_valve_type(),
                                                    selector_type(),
                                                    heater_type(),
                                                    cooler_type(),
                                                    heat_exchanger_type(),
                                                    closed_tank_type(),
                                                    three_way_valve_type(),
                                                    mixer_type(),
                                                    level_sensor_type(),
                                                    temperature_sensor_type(),
                                                    flow_sensor_type(),
                                                    pressure_sensor_type(),
                                                    analog_input_type(),
                                                    analog_output_type(),
                                                    position_switch_type(),
                                                    carriage_type(),
                                                    motor_type(),
                                                    conveyor_type(),
                                                    photo_eye_type(),
                                                    cylinder_type(),
                                                    axis_type(),
                                                    push_button_type(),
                                                    lamp_type(),
                                                    fmu_type(),
                                                    first_order_type(),
                                                    double_tank_type(),
                                                    pendulum_type()};
  return kTypes;
}

}  // namespace stepwright::components::library
