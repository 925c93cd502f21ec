#include "supervisor/fleet/vda5050/link/vehicle_reading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace stepwright::vda5050_link {

using namespace fleet::vda5050;

namespace {

constexpr int kEmergencyStop = 24;
constexpr int kForks = 23;
constexpr int kNoLoad = 29;
// A vehicle stops by itself when it is 0.6 m off its path.
constexpr double kOff_m = 1.0;
// Behind a stop: it is done whatever the supervisor says, whose word comes later than the image.
constexpr double kBehindStop_m = 0.3;

struct ErrorWords {
  int id;
  const char* type;
  const char* text;
};
constexpr std::array kErrors = {
    ErrorWords{20, "noPath", "the controller has no path for the vehicle, or a bad one"},
    ErrorWords{21, "offPath", "the vehicle is more than 0.6 m off its path"},
    ErrorWords{22, "notMoving", "the vehicle is commanded to move and does not"},
    ErrorWords{23, "forksNotMoving", "the forks do not come to their end"},
    ErrorWords{24, "emergencyStop", "the emergency stop was pressed"},
    ErrorWords{25, "bumper", "the bumper was touched"},
    ErrorWords{26, "navigationFrozen", "the navigation shows the same place while the wheels turn"},
    ErrorWords{27, "localizationLost", "the navigation shows another place than the wheels lead to"},
    ErrorWords{28, "outOfEnvelope", "the outline is outside of the polygons that are the vehicle's"},
    ErrorWords{29, "noLoad", "the forks were lifted and nothing is on them"},
    ErrorWords{30, "navigationWalksAway", "the navigation moves otherwise than wheels and steering say"}};

VehicleError fatal(std::string type, std::string description) {
  return {.type = std::move(type),
          .level = ErrorLevel::Fatal,
          .description = std::move(description),
          .references = {}};
}

std::vector<VehicleError> errors_of(const Shown& shown) {
  std::vector<VehicleError> errors;
  const VehicleImage& seen = shown.image;
  if (!shown.controller.empty()) errors.push_back(fatal("controllerStopped", shown.controller));
  if (seen.error_id != 0) {
    auto [type, text] = words_of_error(seen.error_id);
    errors.push_back(fatal(std::move(type), std::move(text)));
    errors.back().references = {{"errorId", std::to_string(seen.error_id)},
                                {"x", std::to_string(seen.error_x_m)},
                                {"y", std::to_string(seen.error_y_m)},
                                {"polygon", std::to_string(seen.error_area)}};
  }
  if (shown.vehicle.state == "lost" || (shown.vehicle.state == "stopped" && seen.error_id == 0)) {
    errors.push_back(
        fatal(shown.vehicle.state == "lost" ? "vehicleLost" : "vehicleStopped", shown.vehicle.reason));
  }
  return errors;
}

// Stops with work that the vehicle has reached and not finished. Of a stop that it has left behind the
// supervisor's word is not waited for.
std::size_t unfinished_stops(const Shown& shown) {
  const std::size_t told = shown.vehicle.stops_done.value_or(0);
  std::size_t unfinished = 0;
  for (std::size_t s = 0; s < shown.mission.stops.size(); ++s) {
    const fleet::Stop& stop = shown.mission.stops[s];
    const bool reached = stop.arc_m <= shown.image.arc_m + kReach_m;
    const bool done = s < told || shown.image.done || stop.arc_m <= shown.image.arc_m - kBehindStop_m;
    if (fleet::moves_load(stop.kind) && reached && !done) ++unfinished;
  }
  return unfinished;
}

}  // namespace

std::pair<std::string, std::string> words_of_error(int error_id) {
  const auto found = std::ranges::find(kErrors, error_id, &ErrorWords::id);
  if (found != kErrors.end()) return {found->type, found->text};
  return {"controllerError", "the controller has stopped the vehicle, error " + std::to_string(error_id)};
}

VehicleLocation location_of(const VehicleImage& image, const fleet::VehicleMission& mission) {
  const auto most = static_cast<int>(mission.grown.visits.size());
  return {.arc_m = image.arc_m, .left = static_cast<std::uint32_t>(std::clamp(image.left, 0, most))};
}

bool plausible(const VehicleImage& image, const fleet::VehicleMission& mission) {
  if (!image.known || image.error_id != 0) return image.known;
  const auto& visits = mission.grown.visits;
  const auto& path = mission.path;
  if (image.left < 0 || image.left >= static_cast<int>(visits.size())) return false;
  if (image.arc_m > path.back().arc_m + kOff_m) return false;
  if (image.left > 0 && image.arc_m < visits[static_cast<std::size_t>(image.left)].entry_m - kOff_m)
    return false;
  const auto at = std::ranges::lower_bound(path, image.arc_m, {}, &geometry::PathPose::arc_m);
  const geometry::Pose& pose = at == path.end() ? path.back().pose : at->pose;
  return geometry::distance(pose.position(), {image.x_m, image.y_m}) <= kOff_m;
}

VehicleReading reading_of(const Shown& shown) {
  const VehicleImage& seen = shown.image;
  VehicleReading reading;
  if (seen.known) {
    reading.position = AgvPosition{.x_m = seen.x_m,
                                   .y_m = seen.y_m,
                                   .theta_rad = std::remainder(seen.heading_rad, 2.0 * std::numbers::pi),
                                   .map_id = shown.map_id,
                                   .initialized = true};
  }
  const double turn = seen.wheelbase_m > 0.0 ? std::tan(seen.lock_rad) / seen.wheelbase_m : 0.0;
  reading.velocity = {.vx_mps = seen.speed_mps, .vy_mps = 0.0, .omega_radps = seen.speed_mps * turn};
  reading.driving = !seen.standing;
  const double arc_m = seen.done ? shown.mission.path.back().arc_m : seen.arc_m;
  if (const Order* const order = shown.orders.order(shown.mission.vehicle))
    reading.order_id = order->order_id;
  reading.passed = shown.orders.passed(shown.mission.vehicle, arc_m, kReach_m);
  reading.unfinished = unfinished_stops(shown);
  reading.action_failed = seen.error_id == kForks || seen.error_id == kNoLoad;
  reading.loads = seen.loaded ? 1 : 0;
  reading.errors = errors_of(shown);
  const bool stopped = !seen.estop_ok || seen.error_id == kEmergencyStop;
  reading.emergency_stop = stopped ? EmergencyStop::Manual : EmergencyStop::None;
  reading.field_violation = seen.bumper;
  return reading;
}

}  // namespace stepwright::vda5050_link
