#include "tests/bench/shift/plant.h"

#include <cmath>
#include <numbers>

namespace stepwright::bench::shift {

namespace {

constexpr double kRadPerCentidegree = std::numbers::pi / 18000.0;

// The blocked cells as few rectangles: runs in rows, joined where the next rows have the same run.
std::vector<assemblies::BlockParameters> walls_of(const fleet::OccupancyGrid& grid) {
  const fleet::GridFrame& frame = grid.frame();
  std::vector<assemblies::BlockParameters> walls;
  std::vector<char> done(static_cast<std::size_t>(frame.columns) * static_cast<std::size_t>(frame.rows), 0);
  const auto open = [&](int column, int row) {
    return grid.blocked({column, row}) &&
           done[static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.columns) +
                static_cast<std::size_t>(column)] == 0;
  };
  for (int row = 0; row < frame.rows; ++row) {
    for (int first = 0; first < frame.columns; ++first) {
      if (!open(first, row)) continue;
      int last = first;
      while (last + 1 < frame.columns && open(last + 1, row)) ++last;
      int top = row;
      const auto whole = [&](int r) {
        for (int c = first; c <= last; ++c)
          if (!open(c, r)) return false;
        return (first == 0 || !open(first - 1, r)) && (last + 1 == frame.columns || !open(last + 1, r));
      };
      while (top + 1 < frame.rows && whole(top + 1)) ++top;
      for (int r = row; r <= top; ++r) {
        for (int c = first; c <= last; ++c)
          done[static_cast<std::size_t>(r) * static_cast<std::size_t>(frame.columns) +
               static_cast<std::size_t>(c)] = 1;
      }
      const geometry::Point low = frame.corner({first, row});
      const geometry::Point high = frame.corner({last + 1, top + 1});
      walls.push_back({{{high.x_m - low.x_m, high.y_m - low.y_m}},
                       {{0.5 * (low.x_m + high.x_m), 0.5 * (low.y_m + high.y_m)}, 0.0}});
    }
  }
  return walls;
}

}  // namespace

result::Result<Plant> Plant::create(const Scenario& scenario) {
  assemblies::FleetParameters parameters;
  for (std::uint32_t v = 0; v < scenario.settings.vehicles; ++v) {
    const geometry::Pose& bay = scenario.hall.bays[v];
    parameters.starts.push_back({bay.x_m, bay.y_m, bay.heading_rad});
  }
  parameters.walls = walls_of(scenario.hall.grid);
  for (const Rectangle& place : scenario.places) {
    parameters.blockages.push_back(
        {{{place.high.x_m - place.low.x_m, place.high.y_m - place.low.y_m}},
         {{0.5 * (place.low.x_m + place.high.x_m), 0.5 * (place.low.y_m + place.high.y_m)}, 0.0}});
  }
  parameters.seed = scenario.settings.seed;
  auto floor = assemblies::FleetFloor::create(parameters);
  if (!floor) return result::forward(floor);
  Plant plant;
  plant.floor_ = *std::move(floor);
  for (std::uint32_t v = 0; v < scenario.settings.vehicles; ++v) {
    const std::string name = "v" + std::to_string(v + 1);
    const auto sensor = [&](const char* kind) { return *core::find_sensor(*plant.floor_, kind + name); };
    const auto actuator = [&](const char* kind) { return *core::find_actuator(*plant.floor_, kind + name); };
    plant.ports_.push_back({sensor("x_"), sensor("y_"), sensor("heading_"), sensor("speed_"), sensor("lock_"),
                            sensor("bumper_"), actuator("enable_"), actuator("set_speed_"),
                            actuator("set_lock_")});
  }
  plant.contacts_ = *core::find_truth(*plant.floor_, "contacts");
  return plant;
}

fleet::VehicleState Plant::measured(std::uint32_t vehicle) const {
  const Ports& p = ports_[vehicle];
  return {0.01 * floor_->sensor(p.x), 0.01 * floor_->sensor(p.y),
          kRadPerCentidegree * floor_->sensor(p.heading), 0.001 * floor_->sensor(p.speed),
          kRadPerCentidegree * floor_->sensor(p.lock)};
}

bool Plant::bumper(std::uint32_t vehicle) const {
  return floor_->sensor(ports_[vehicle].bumper) != 0;
}

void Plant::command(std::uint32_t vehicle, const fleet::DriveCommand& drive, bool enable) {
  const Ports& p = ports_[vehicle];
  floor_->set_actuator(p.enable, enable ? 1 : 0);
  floor_->set_actuator(p.set_speed, static_cast<std::int16_t>(std::lround(1000.0 * drive.speed_m_s)));
  floor_->set_actuator(p.set_lock,
                       static_cast<std::int16_t>(std::lround(drive.lock_rad / kRadPerCentidegree)));
}

geometry::Pose Plant::pose(std::uint32_t vehicle) const {
  const assemblies::ForkliftPose at = floor_->vehicle_pose(vehicle);
  return {at.x_m, at.y_m, at.heading_rad};
}

void Plant::set_dead(std::uint32_t vehicle, bool dead) {
  const std::string name = "dead_v" + std::to_string(vehicle + 1);
  if (dead) {
    static_cast<void>(floor_->inject_fault(name, 1.0));
  } else {
    static_cast<void>(floor_->clear_fault(name));
  }
}

void Plant::set_blocked(std::uint32_t place, bool blocked) {
  const std::string name = "block_" + std::to_string(place + 1);
  if (blocked) {
    static_cast<void>(floor_->inject_fault(name, 1.0));
  } else {
    static_cast<void>(floor_->clear_fault(name));
  }
}

}  // namespace stepwright::bench::shift
