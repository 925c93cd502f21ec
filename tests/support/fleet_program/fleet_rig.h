#pragma once

// A plan compiled by the ordinary driver and run on both engines in lock-step with simulated vehicles, and a
// check that looks at nothing but where these are.
//
//   FleetRig rig(plan, {});
//   rig.run(120.0);
//   EXPECT_TRUE(rig.all_arrived());

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plant_models/assemblies/fleet_floor.h"
#include "plant_models/bridge/plant_driver.h"
#include "runtime/bytecode/reader/program_info.h"
#include "supervisor/fleet/program/fleet_program.h"
#include "tests/support/lock_step/host_machine.h"

namespace stepwright::fleet {

struct RigOptions {
  std::uint64_t seed = 1;
  bool native = true;                   // machine code beside the interpreter, hash by hash
  const OccupancyGrid* grid = nullptr;  // outlines are held against it
  bool interlocks = true;               // false: transitions look at the way only
  std::vector<assemblies::PalletParameters> pallets = {};
  ProgramOptions program = {};
};

// Removes the interlocks of a program: for tests of the check.
void remove_interlocks(FleetProgram& program);

class FleetRig {
 public:
  FleetRig(const FleetPlan& plan, const RigOptions& options);

  void scan();
  // Until then, or until all have arrived.
  void run(double until_s);
  bool all_arrived() const;
  bool arrived(std::size_t vehicle) const { return value(watched_[vehicle].done) != 0.0; }
  double time_s() const { return 1e-9 * static_cast<double>(now_ns_); }

  double number(const std::string& path) const { return value(variable(path)); }
  // Of the globals that belong to one vehicle: "enable".
  double global(const std::string& what, std::size_t vehicle) const {
    return number(what + "_" + name(vehicle));
  }
  double of(const std::string& member, std::size_t vehicle) const {
    return number("vehicle_" + name(vehicle) + "." + member);
  }
  void set(const std::string& path, bool value);
  std::string name(std::size_t vehicle) const { return program_.missions[vehicle].name; }
  geometry::Pose pose(std::size_t vehicle) const;
  assemblies::FleetFloor& floor() { return *floor_; }
  double truth(const std::string& name) const { return floor_->truth(*core::find_truth(*floor_, name)); }
  void fault(const std::string& name, double value);
  const FleetProgram& program() const { return program_; }
  std::string state() const;  // of all vehicles, for messages

  // Results of the check.
  std::size_t overlaps = 0;  // instants at which outlines of two vehicles shared a point
  std::size_t wall_hits = 0;
  std::string first_fault;
  std::vector<double> arrival_s;  // by vehicle; 0 = not yet
  std::vector<double> most_deviation_m;
  double most_overrun_m = -1e9;  // of a vehicle beyond the way that its chart permits
  bool engines_agree = true;

 private:
  // Variables that every scan reads, looked up once.
  struct Watched {
    reader::Variable done;
    reader::Variable arc;
    reader::Variable permitted;
    reader::Variable deviation;
  };

  void judge();
  void watch(std::size_t vehicle);
  reader::Variable variable(const std::string& path) const;
  double value(const reader::Variable& variable) const;

  const FleetPlan& plan_;
  RigOptions options_;
  FleetProgram program_;
  std::unique_ptr<assemblies::FleetFloor> floor_;
  std::optional<bridge::PlantDriver> driver_;
  std::unique_ptr<support::HostMachine> vm_;
  std::unique_ptr<support::HostMachine> native_;
  std::optional<reader::ProgramInfo> info_;
  std::vector<Watched> watched_;
  std::vector<std::byte> inputs_;
  std::int64_t now_ns_ = 0;
};

}  // namespace stepwright::fleet
