#include "supervisor/fleet/vda5050/factsheet.h"

namespace stepwright::fleet::vda5050 {

Factsheet factsheet_of(const VehicleModel& model, const SpeedLimits& speed, const Header& header,
                       const VehicleType& type) {
  const double half = 0.5 * model.width_m;
  const double track = half - 0.5 * type.wheel_width_m;
  return {.header = header,
          .type = type,
          .speed_min_mps = speed.min_mps,
          .speed_max_mps = speed.max_mps,
          .length_m = model.front_m + model.rear_m,
          .width_m = model.width_m,
          .wheels = {{.driven = false, .steered = false, .x_m = 0.0, .y_m = track},
                     {.driven = false, .steered = false, .x_m = 0.0, .y_m = -track},
                     {.driven = true, .steered = true, .x_m = -model.wheelbase_m, .y_m = 0.0}},
          .outline = {
              {model.front_m, half}, {-model.rear_m, half}, {-model.rear_m, -half}, {model.front_m, -half}}};
}

}  // namespace stepwright::fleet::vda5050
