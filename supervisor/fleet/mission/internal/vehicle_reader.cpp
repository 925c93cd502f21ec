#include "supervisor/fleet/mission/internal/vehicle_reader.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "supervisor/fleet/mission/internal/drawn_path.h"
#include "supervisor/fleet/network/constraint.h"
#include "supervisor/fleet/schedule/problem_file.h"

namespace stepwright::fleet::internal {

namespace {

constexpr double kFar_m = 1e6;
constexpr double kRadians = std::numbers::pi / 180.0;
constexpr double kMostDegrees = 360.0;
constexpr double kMostSpeed_mps = 100.0;
constexpr std::int64_t kMostLoad = 1'000'000;
constexpr std::size_t kMostPoses = 1'000'000;

struct ModelKey {
  const char* name;
  double VehicleModel::*value;
};
constexpr std::array kModelKeys = {
    ModelKey{"wheelbase_m", &VehicleModel::wheelbase_m},
    ModelKey{"min_turning_radius_m", &VehicleModel::min_turning_radius_m},
    ModelKey{"max_steering_rad", &VehicleModel::max_steering_rad},
    ModelKey{"front_m", &VehicleModel::front_m},
    ModelKey{"rear_m", &VehicleModel::rear_m},
    ModelKey{"width_m", &VehicleModel::width_m},
};

VehicleClass read_class(const JsonItem& item, std::string name, JsonComplaints& complaints) {
  VehicleClass read{.name = std::move(name), .model = {}, .key = item.key()};
  if (!item.object({"name", "wheelbase_m", "min_turning_radius_m", "max_steering_rad", "front_m", "rear_m",
                    "width_m"})) {
    return read;
  }
  const std::size_t before = complaints.found.size();
  for (const ModelKey& key : kModelKeys) {
    if (const auto number = item.number(key.name, -kFar_m, kFar_m, false)) read.model.*key.value = *number;
  }
  if (complaints.found.size() > before) return read;
  for (auto& wrong : check(read.model, complaints.where(item.key()), item.key() + ".")) {
    complaints.found.push_back(std::move(wrong));
  }
  return read;
}

void read_classes(const JsonItem& root, MissionProblem& problem, Names& models, JsonComplaints& complaints) {
  for (const JsonItem& item : root.items("models")) {
    const auto name = item.value().is_object() ? item.text("name") : std::nullopt;
    problem.classes.push_back(read_class(item, name.value_or(""), complaints));
    if (name) models.add(item, *name, problem.classes.size() - 1);
  }
}

// By name, written out in place, or the first one of the file.
std::size_t class_of(const JsonItem& item, const std::string& vehicle, MissionProblem& problem,
                     const Names& models, JsonComplaints& complaints) {
  const auto model = item.maybe("model");
  if (model && !model->value().is_object()) return models.find(*model).value_or(0);
  if (!model && !problem.classes.empty()) return 0;
  problem.classes.push_back(model ? read_class(*model, vehicle, complaints)
                                  : VehicleClass{.name = "forklift", .model = {}, .key = item.key()});
  return problem.classes.size() - 1;
}

void read_speed(const JsonItem& item, MissionVehicle& vehicle, JsonComplaints& complaints) {
  const std::size_t before = complaints.found.size();
  if (const auto least = item.number("min_mps", 0.0, kMostSpeed_mps, false)) vehicle.speed.min_mps = *least;
  if (const auto most = item.number("max_mps", 0.0, kMostSpeed_mps, false)) vehicle.speed.max_mps = *most;
  if (complaints.found.size() > before) return;
  const char* key = item.has("min_mps") ? "min_mps" : "max_mps";
  for (auto& wrong : check(vehicle.speed, complaints.where(item.key_of(key)), item.key() + ".")) {
    complaints.found.push_back(std::move(wrong));
  }
}

void read_path(const JsonItem& list, const VehicleModel& model, MissionVehicle& vehicle) {
  std::vector<geometry::Pose> poses;
  const auto items = list.as_items();
  if (items.size() > kMostPoses) return list.refuse("F0709", "has more than a million poses");
  for (const JsonItem& item : items) {
    const auto parts = item.as_items();
    if (parts.size() != 3) {
      item.refuse("F0702", "is no pose [x_m, y_m, heading_deg]");
      return;
    }
    const auto x = parts[0].as_number(-kFar_m, kFar_m);
    const auto y = parts[1].as_number(-kFar_m, kFar_m);
    const auto heading = parts[2].as_number(-kMostDegrees, kMostDegrees);
    if (!x || !y || !heading) return;
    poses.push_back({*x, *y, *heading * kRadians});
  }
  DrawnPath drawn = join_poses(poses, model);
  if (!drawn.fault.empty()) {
    return (items.empty() ? list : items[drawn.wrong]).refuse("F0709", drawn.fault);
  }
  vehicle.start = drawn.path.front().pose;
  vehicle.path = std::move(drawn.path);
}

// By the reader of the scheduler's problems.
void read_envelope(const JsonItem& item, MissionVehicle& vehicle, JsonComplaints& complaints) {
  auto read = read_polygons(item.value().at("polygons"), item.key_of("polygons"));
  if (read)
    vehicle.envelope = {.vehicle = vehicle.name, .polygons = *std::move(read)};
  else
    complaints.add(read.error().code, read.error().key, read.error().what, read.error().hint);
}

MissionVehicle read_vehicle(const JsonItem& item, MissionProblem& problem, const Names& models,
                            JsonComplaints& complaints) {
  MissionVehicle vehicle;
  vehicle.key = item.key();
  if (!item.object({"name", "model", "min_mps", "max_mps", "start", "capacity", "available_ms", "route",
                    "path", "polygons"})) {
    return vehicle;
  }
  vehicle.name = item.text("name").value_or("");
  vehicle.vehicle_class = class_of(item, vehicle.name, problem, models, complaints);
  read_speed(item, vehicle, complaints);
  vehicle.capacity = static_cast<std::uint32_t>(item.whole("capacity", 0, kMostLoad, false).value_or(1));
  vehicle.available =
      std::chrono::milliseconds(item.whole("available_ms", 0, kHorizon_ms, false).value_or(0));
  const int ways = int(item.has("start")) + int(item.has("path")) + int(item.has("polygons"));
  if (ways != 1) {
    item.refuse(ways == 0 ? "F0702" : "F0706",
                ways == 0 ? "lacks 'start'" : "has more than one of 'start', 'path' and 'polygons'",
                "where it begins, or the path that it drives, or its whole envelope");
    return vehicle;
  }
  if (const auto start = item.maybe("start")) vehicle.start = read_pose(*start);
  if (const auto path = item.maybe("path")) {
    const auto& classes = problem.classes;
    read_path(*path,
              vehicle.vehicle_class < classes.size() ? classes[vehicle.vehicle_class].model : VehicleModel{},
              vehicle);
  }
  if (item.has("polygons")) read_envelope(item, vehicle, complaints);
  return vehicle;
}

}  // namespace

geometry::Pose read_pose(const JsonItem& item) {
  if (!item.object({"x_m", "y_m", "heading_deg"})) return {};
  const auto x = item.number("x_m", -kFar_m, kFar_m);
  const auto y = item.number("y_m", -kFar_m, kFar_m);
  const auto heading = item.number("heading_deg", -kMostDegrees, kMostDegrees);
  return {x.value_or(0.0), y.value_or(0.0), heading.value_or(0.0) * kRadians};
}

void read_vehicles(const JsonItem& root, MissionProblem& problem, Names& names, JsonComplaints& complaints) {
  Names models("model");
  read_classes(root, problem, models, complaints);
  for (const JsonItem& item : root.items("vehicles", true)) {
    problem.vehicles.push_back(read_vehicle(item, problem, models, complaints));
    const std::string& name = problem.vehicles.back().name;
    if (!name.empty()) names.add(item, name, problem.vehicles.size() - 1);
  }
}

}  // namespace stepwright::fleet::internal
