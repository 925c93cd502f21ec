#include "cell/hmi/floor_picture.h"

#include <numbers>
#include <string>

#include "cell/hmi/wall_outlines.h"

namespace stepwright::hmi {
namespace {

// What one count of a terminal is worth.
constexpr double kCentimetre_m = 0.01;
constexpr double kMillimetre_m = 0.001;
constexpr double kCentidegree_rad = std::numbers::pi / 18'000.0;

protocol::Forklift forklift(const core::ForkliftDescription& vehicle, PicturePoints& points) {
  const std::string& v = vehicle.name;
  const auto port = [&](const char* what) { return what + ("_" + v); };
  const auto id = [&](const char* what) { return v + "." + what; };
  protocol::Forklift drawn;
  drawn.id = v;
  drawn.label = v;
  drawn.front_m = vehicle.front;
  drawn.rear_m = vehicle.rear;
  drawn.width_m = vehicle.width;
  drawn.wheelbase_m = vehicle.wheelbase;
  drawn.x_point = points.counted(id("x"), "m", port("x"), kCentimetre_m);
  drawn.y_point = points.counted(id("y"), "m", port("y"), kCentimetre_m);
  drawn.heading_point = points.counted(id("heading"), "rad", port("heading"), kCentidegree_rad);
  drawn.speed_point = points.counted(id("speed"), "m/s", port("speed"), kMillimetre_m);
  drawn.lock_point = points.counted(id("lock"), "rad", port("lock"), kCentidegree_rad);
  drawn.loaded_point = points.terminal(id("loaded"), port("loaded"));
  drawn.bumper_point = points.terminal(id("bumper"), port("bumper"));
  drawn.enable_point = points.terminal(id("enable"), port("enable"));
  drawn.lift_point = points.terminal(id("lift"), port("lift"));
  drawn.true_x_point = points.truth(id("true_x"), v + ", true x", "m", false, vehicle.x_truth);
  drawn.true_y_point = points.truth(id("true_y"), v + ", true y", "m", false, vehicle.y_truth);
  drawn.true_heading_point =
      points.truth(id("true_heading"), v + ", true heading", "rad", false, vehicle.heading_truth);
  drawn.carries_point = points.truth(id("carries"), "pallet on " + v, "", false, vehicle.load_truth);
  return drawn;
}

protocol::Pallet pallet(const core::BoxDescription& box, PicturePoints& points) {
  const std::string id = "pallet " + box.name;
  return {id,
          box.name,
          box.length,
          box.width,
          points.truth(id + ".state", id, "", false, box.state_truth),
          points.truth(id + ".x", id, "m", false, box.x_truth),
          points.truth(id + ".y", id, "m", false, box.y_truth),
          points.truth(id + ".angle", id, "rad", false, box.angle_truth)};
}

protocol::Blockage blockage(const core::ObstacleDescription& place, PicturePoints& points) {
  return {place.name,  place.name,
          place.x,     place.y,
          place.angle, place.length,
          place.width, points.truth(place.name + ".there", place.name, "", false, place.there_truth)};
}

}  // namespace

protocol::Floor floor_of(const core::PlantDescription& plant, const fleet::OccupancyGrid* map,
                         PicturePoints& points) {
  protocol::Floor floor;
  if (map != nullptr) floor.maps.push_back(outlined(*map));
  for (const auto& vehicle : plant.forklifts) floor.forklifts.push_back(forklift(vehicle, points));
  for (const auto& box : plant.boxes) floor.pallets.push_back(pallet(box, points));
  for (const auto& place : plant.obstacles) {
    if (!place.name.empty()) floor.blockages.push_back(blockage(place, points));
  }
  floor.estop_ok_point = points.terminal("estop_ok", "estop_ok");
  return floor;
}

}  // namespace stepwright::hmi
