#pragma once

// The simulated floor behind its terminals: measured states and set points of vehicles by number. One thread.

#include <memory>
#include <string>
#include <vector>

#include "plant_models/assemblies/fleet_floor.h"
#include "supervisor/fleet/control/drive_limits.h"
#include "tests/bench/shift/scenario.h"

namespace stepwright::bench::shift {

class Plant {
 public:
  [[nodiscard]] static result::Result<Plant> create(const Scenario& scenario);

  fleet::VehicleState measured(std::uint32_t vehicle) const;
  bool bumper(std::uint32_t vehicle) const;
  void command(std::uint32_t vehicle, const fleet::DriveCommand& drive, bool enable);
  bool step(std::chrono::nanoseconds to) { return floor_->advance_to(to) == core::PlantStatus::Good; }
  geometry::Pose pose(std::uint32_t vehicle) const;
  double contacts() const { return floor_->truth(contacts_); }

  // Faults that the plant has by these names.
  void set_dead(std::uint32_t vehicle, bool dead);
  void set_blocked(std::uint32_t place, bool blocked);

 private:
  struct Ports {
    core::SensorId x, y, heading, speed, lock, bumper;
    core::ActuatorId enable, set_speed, set_lock;
  };
  Plant() = default;

  std::unique_ptr<assemblies::FleetFloor> floor_;
  std::vector<Ports> ports_;
  core::TruthId contacts_{0};
};

}  // namespace stepwright::bench::shift
