#pragma once

// A floor with forklifts as a plant: CVODE moves the vehicles (forklift.h), Box2D says what they run into and
// where pallets are pushed to. Thread rule and terminal semantics: core::Plant. plant_models/doc/forklift.md
// has the model.
//
// Reproducible: everything advances by fixed steps of 10 ms of plant time, whatever advance_to() is asked;
// what is commanded takes effect with the next step. Same parameters and the same calls at the same instants:
// the same bits, on machines with the same libraries. Invariant: a pallet stands on the floor or is carried
// by one vehicle.
//
//   auto floor = FleetFloor::create({.starts = {{2.0, 3.0, 0.0}}});
//   if (!floor) return forward(floor);
//   (*floor)->set_actuator(*core::find_actuator(**floor, "enable_v1"), 1);
//   (*floor)->set_actuator(*core::find_actuator(**floor, "set_speed_v1"), 1000);
//   (*floor)->advance(std::chrono::milliseconds(10));

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "plant_models/assemblies/fleet_ports.h"
#include "plant_models/assemblies/overlap_monitor.h"
#include "plant_models/body2d/world.h"
#include "plant_models/core/counter_random.h"
#include "plant_models/core/plant.h"

namespace stepwright::assemblies {

inline constexpr std::chrono::nanoseconds kFleetStep{10'000'000};
inline constexpr double kFleetStepS = 0.01;
inline constexpr double kChassisFront_m =
    0.25;  // where the chassis ends and the forks begin, before the front axle

class FleetFloor final : public core::Plant {
 public:
  // Fails with the diagnostics of validate(), or with C0331 (solver).
  [[nodiscard]] static result::Result<std::unique_ptr<FleetFloor>> create(const FleetParameters& parameters);

  std::span<const core::Port> actuators() const override { return ports_.actuators; }
  std::span<const core::Port> sensors() const override { return ports_.sensors; }
  std::span<const core::Quantity> truths() const override { return ports_.truths; }
  std::span<const core::Quantity> faults() const override { return ports_.faults; }
  core::FaultRange fault_range(std::size_t fault) const override { return ports_.fault_ranges[fault]; }
  std::string violation() const override;
  const core::PlantDescription& description() const override { return description_; }

  std::chrono::nanoseconds now() const override { return now_; }
  void set_actuator(core::ActuatorId id, std::int16_t value) override;
  core::PlantStatus advance_to(std::chrono::nanoseconds time) override;
  std::int16_t sensor(core::SensorId id) const override;
  double truth(core::TruthId id) const override;
  [[nodiscard]] result::Result<void> inject_fault(std::string_view name, double value) override;
  [[nodiscard]] result::Result<void> clear_fault(std::string_view name) override;

  // Poses of vehicles and pallets: x and y in m, angle in rad; and who carries what.
  std::size_t kept_size() const override;
  void keep(std::span<double> numbers) const override;
  // Goes on from what a floor with as many vehicles and pallets kept, at rest. False, and nothing happens, if
  // no floor can have kept it.
  bool resume(std::span<const double> numbers);

  // Where vehicle `index` is, for checks of tests.
  ForkliftPose vehicle_pose(std::size_t index) const { return vehicles_[index].forklift->pose(); }
  std::uint64_t state_hash() const;

 private:
  struct Pallet {
    body2d::BodyId body;
    double load_kg = 0.0;
    std::optional<std::size_t> carrier;
  };
  struct Vehicle {
    std::unique_ptr<Forklift> forklift;
    body2d::BodyId body;
    // As commanded.
    bool enable = false;
    std::int16_t speed_mm_s = 0;
    std::int16_t lock_centidegrees = 0;
    bool lift = false;
    // How it is.
    double lift_travel = 0.0;  // 0 = down, 1 = up
    bool tripped = false;      // by a contact, until enable is off
    std::optional<std::size_t> pallet;
    body2d::Pose pallet_grip;  // of the pallet, in the frame of the reference point
    // Faults.
    bool dead = false;
    double drift_cm_s = 0.0;
    double drift_since_s = 0.0;
    std::optional<ForkliftPose> frozen;  // what the navigation goes on showing
  };

  explicit FleetFloor(const FleetParameters& parameters);
  [[nodiscard]] result::Result<void> add_vehicles();
  void add_bodies();

  bool step();
  bool move_vehicle(Vehicle& vehicle, double end_s);
  void feel_contacts(Vehicle& vehicle);
  void move_forks(std::size_t index);
  void pick(std::size_t index);
  void take(std::size_t vehicle, std::size_t pallet);
  void drop(Vehicle& vehicle);
  body2d::Pose chassis_pose(const ForkliftPose& pose) const;
  body2d::Pose carried_pose(const Vehicle& vehicle, const ForkliftPose& pose) const;
  std::int16_t counts_of(const Vehicle& vehicle, std::size_t index, FleetSensor kind) const;
  double noise(std::size_t vehicle, FleetSensor kind) const;
  void apply_fault(std::size_t fault, double value, bool active);
  void apply_vehicle_fault(Vehicle& vehicle, FleetFault kind, double value, bool active);
  double time_s() const;

  FleetParameters parameters_;
  FleetPorts ports_;
  core::PlantDescription description_;
  body2d::World world_;
  std::vector<Vehicle> vehicles_;
  std::vector<Pallet> pallets_;
  std::vector<body2d::BodyId> blockages_;
  OverlapMonitor overlap_monitor_;
  bool emergency_stop_ = false;
  int contacts_ = 0;
  double greatest_force_n_ = 0.0;
  std::int64_t steps_ = 0;
  std::chrono::nanoseconds now_{0};
  bool failed_ = false;
};

}  // namespace stepwright::assemblies
