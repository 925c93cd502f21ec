#pragma once

// The tank bench of paper 6 as a plant: CVODE integrates between events, an event changes the modes.
// Thread rule and terminal semantics: core::Plant. Ports, truths and faults by name: bench_ports.h.
//
// Reproducible: the solver restarts only when an actuator really changes, a fault changes, or an event
// changes the equations; its steps do not depend on when the plant is looked at. So the state at an
// instant depends on parameters and on the instants of those changes only, bit for bit, however finely
// advance_to() slices the time; and sensor noise is a function of seed and time.
//
//   auto bench = TankBench::create({.seed = 7});
//   if (!bench) return forward(bench);
//   (*bench)->set_actuator(core::ActuatorId(index(Pump::B1)), true);
//   (*bench)->advance(std::chrono::milliseconds(10));

#include <array>
#include <chrono>
#include <memory>
#include <optional>

#include "plant_models/assemblies/bench_equations.h"
#include "plant_models/assemblies/bench_parameters.h"
#include "plant_models/assemblies/bench_ports.h"
#include "plant_models/assemblies/level_sensor.h"
#include "plant_models/core/plant.h"
#include "plant_models/ode/cvode_solver.h"

namespace stepwright::assemblies {

class TankBench final : public core::Plant {
 public:
  // Fails with the diagnostics of validate(), or with C0331 (solver).
  [[nodiscard]] static result::Result<std::unique_ptr<TankBench>> create(const BenchParameters& parameters);

  std::span<const core::Port> actuators() const override;
  std::span<const core::Port> sensors() const override;
  std::span<const core::Quantity> truths() const override;
  std::span<const core::Quantity> faults() const override;
  core::FaultRange fault_range(std::size_t fault) const override;
  const core::PlantDescription& description() const override { return description_; }

  std::chrono::nanoseconds now() const override { return now_; }
  void set_actuator(core::ActuatorId id, std::int16_t value) override;
  core::PlantStatus advance_to(std::chrono::nanoseconds time) override;
  std::int16_t sensor(core::SensorId id) const override;
  double truth(core::TruthId id) const override;
  [[nodiscard]] result::Result<void> inject_fault(std::string_view name, double value) override;
  [[nodiscard]] result::Result<void> clear_fault(std::string_view name) override;

  // Position in m, then the levels of f1, v1, a1 and a2 in percent.
  std::size_t kept_size() const override { return 1 + kTanks; }
  void keep(std::span<double> numbers) const override;

  // For benchmarks: what the solver has done.
  ode::CvodeStatistics statistics() const { return solver_->statistics(); }

  // The state vector at now(), as bench_equations.h lays it out: for accuracy tests.
  std::span<const double> state() const { return y_; }

 private:
  struct SwitchFault {
    bool active = false;
    bool shows = false;
  };
  struct DriftFault {
    double counts_per_s = 0.0;
    std::chrono::nanoseconds since{0};
  };

  explicit TankBench(const BenchParameters& parameters);
  TankBench(const TankBench&) = delete;
  TankBench& operator=(const TankBench&) = delete;

  bool run_to(double t_s);
  bool handle_event();
  bool change_place(std::size_t place);
  bool restart(double t_s);
  void update_modes();
  void apply_fault(std::size_t fault, double value, bool active);

  BenchEquations equations_;  // the solver points to it
  core::PlantDescription description_;
  std::array<LevelSensor, kLevelSensors> level_sensors_;
  std::unique_ptr<ode::CvodeSolver> solver_;  // made after the equations stand at their final address
  std::array<double, kStateSize> y_{};        // at now_
  std::array<bool, kActuators> actuators_{};  // as commanded
  std::array<bool, kActuators> applied_{};    // as the modes have them
  std::array<SwitchFault, kPlaces> switch_faults_{};
  std::array<DriftFault, kLevelSensors> drift_faults_{};
  std::array<std::optional<std::int16_t>, kLevelSensors> frozen_{};  // what they go on showing
  std::chrono::nanoseconds now_{0};
  bool fault_changed_ = false;  // at now_: restart before the next step
  bool event_pending_ = false;  // the solver stands at a root that has not been handled
  bool failed_ = false;
};

}  // namespace stepwright::assemblies
