#pragma once

// A tugger train in a hall as a plant: CVODE moves the train (tugger_train.h), boxes and outlines say what it
// runs into (tugger_floor.h). Thread rule and terminal semantics: core::Plant. plant_models/doc/tugger.md has
// the model.
//
// Reproducible: everything advances by fixed steps of 10 ms of plant time, whatever advance_to() is asked;
// what is commanded takes effect with the next step. Same parameters and the same calls at the same instants:
// the same bits, on machines with the same libraries. Invariant: a trailer is coupled, left standing, or not
// there; the coupled ones are the first.
//
//   auto tugger = Tugger::create({.trailers = 3});
//   if (!tugger) return forward(tugger);
//   (*tugger)->set_actuator(*core::find_actuator(**tugger, "enable"), 1);
//   (*tugger)->set_actuator(*core::find_actuator(**tugger, "set_speed"), 1000);
//   (*tugger)->advance(std::chrono::milliseconds(10));

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "plant_models/assemblies/tugger_floor.h"
#include "plant_models/assemblies/tugger_ports.h"
#include "plant_models/assemblies/tugger_train.h"
#include "plant_models/core/plant.h"

namespace stepwright::assemblies {

inline constexpr std::chrono::nanoseconds kTuggerStep{10'000'000};
inline constexpr double kTuggerStepS = 0.01;

class Tugger final : public core::Plant {
 public:
  // Fails with the diagnostics of validate(), or with C0331 (solver).
  [[nodiscard]] static result::Result<std::unique_ptr<Tugger>> create(const TuggerParameters& parameters);

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
  // C0312 also where trailers cannot be coupled: the train moves, or there is no room behind it.
  [[nodiscard]] result::Result<void> inject_fault(std::string_view name, double value) override;
  [[nodiscard]] result::Result<void> clear_fault(std::string_view name) override;

  // Pose of the tractor, then state, middle and heading of each trailer: x and y in m, angles in rad.
  std::size_t kept_size() const override;
  void keep(std::span<double> numbers) const override;
  // Goes on from what a train in the same hall kept, at rest. False, and nothing happens, if none can have
  // kept it.
  bool resume(std::span<const double> numbers);

  const TuggerTrain& train() const { return *train_; }
  std::uint64_t state_hash() const;

 private:
  explicit Tugger(const TuggerParameters& parameters);

  bool step();
  double truth_of_trailer(TuggerTruth kind, std::size_t trailer) const;
  std::int16_t counts_of(TuggerSensor kind, std::size_t index) const;
  double noise(std::uint64_t stream) const;
  void apply_fault(TuggerFault kind, std::size_t index, double value, bool active);
  void leave_trailers(std::size_t stay);
  [[nodiscard]] result::Result<void> check_coupling(double value) const;
  void couple_trailers(std::size_t trailers);
  double time_s() const { return static_cast<double>(steps_) * kTuggerStepS; }

  TuggerParameters parameters_;
  TuggerPorts ports_;
  core::PlantDescription description_;
  std::unique_ptr<TuggerTrain> train_;
  TuggerFloor floor_;
  std::vector<double> before_;  // state at the beginning of a step
  // As commanded.
  bool enable_ = false;
  std::int16_t speed_mm_s_ = 0;
  std::int16_t lock_centidegrees_ = 0;
  // How it is.
  bool tripped_ = false;   // by a contact, until enable is off
  bool touching_ = false;  // something since the last step
  bool changed_ = true;    // the floor, or what stands on it, since the last look at it
  int contacts_ = 0;
  // Faults.
  bool emergency_stop_ = false;
  bool dead_ = false;
  double drift_cm_s_ = 0.0;
  double drift_since_s_ = 0.0;
  std::optional<body2d::Pose> frozen_;  // what the navigation goes on showing
  std::int64_t steps_ = 0;
  std::chrono::nanoseconds now_{0};
  bool failed_ = false;
};

}  // namespace stepwright::assemblies
