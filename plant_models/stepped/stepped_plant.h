#pragma once

// A plant whose model is a process of its own: terminals with their scaling, steps of a fixed length in
// lock-step with the scan, faults by name. Of a cell whose plant is a program of somebody else's, an FMU or a
// program in ST (plant_models/doc/shared_plant.md).
//
// Without a process (before start()) it has its terminals and faults and nothing moves: enough to check a
// cell.
//
// Thread rule and invariants as core::Plant. A plant that is lost stays as it was (PlantStatus::Failed).

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "plant_models/core/plant.h"
#include "plant_models/stepped/step_link.h"

namespace stepwright::stepped {

// number = value_at_zero + value_per_count * counts
struct SteppedTerminal {
  std::string name;
  core::PortKind kind = core::PortKind::Bool;
  double at_zero = 0.0;    // the quantity at 0 counts, in its unit
  double per_count = 1.0;  // of the quantity in one count; not 0
  std::string unit = {};
  std::string meaning = {};
};

struct SteppedDescription {
  std::string name;
  std::vector<SteppedTerminal> actuators = {};
  std::vector<SteppedTerminal> sensors = {};
  std::vector<core::Quantity> values = {};  // true state for reports; what it measures is there by itself
  std::vector<core::Quantity> faults = {};
  std::vector<core::FaultRange> fault_ranges = {};  // one for each, or none at all
  std::chrono::nanoseconds step{10'000'000};
  std::uint64_t seed = 1;
};

class SteppedPlant final : public core::Plant {
 public:
  // `command`: how start() starts its process.
  explicit SteppedPlant(SteppedDescription description, StepCommand command = {});

  // Fails as StepLink::start.
  [[nodiscard]] result::Result<void> start() override;
  std::string trouble() override { return link_ ? link_->trouble() : std::string(); }
  bool failed() const override { return link_ && link_->failed(); }

  std::span<const core::Port> actuators() const override { return actuator_ports_; }
  std::span<const core::Port> sensors() const override { return sensor_ports_; }
  std::span<const core::Quantity> truths() const override { return truths_; }
  std::span<const core::Quantity> faults() const override { return about_.faults; }
  core::FaultRange fault_range(std::size_t fault) const override {
    return fault < about_.fault_ranges.size() ? about_.fault_ranges[fault] : core::FaultRange{0.0, 0.0};
  }
  const core::PlantDescription& description() const override { return picture_; }
  std::chrono::nanoseconds now() const override { return now_; }
  void set_actuator(core::ActuatorId id, std::int16_t value) override;
  core::PlantStatus advance_to(std::chrono::nanoseconds time) override;
  std::int16_t sensor(core::SensorId id) const override { return counts_[id.value]; }
  double truth(core::TruthId id) const override { return numbers_[id.value]; }
  [[nodiscard]] result::Result<void> inject_fault(std::string_view name, double value) override;
  [[nodiscard]] result::Result<void> clear_fault(std::string_view name) override;
  // The state is the process's own: another one begins from its start.
  std::size_t kept_size() const override { return 0; }
  void keep(std::span<double>) const override {}

 private:
  bool sample();
  [[nodiscard]] result::Result<void> set_fault(std::string_view name, double value);

  SteppedDescription about_;
  StepCommand command_;
  std::vector<core::Port> actuator_ports_;
  std::vector<core::Port> sensor_ports_;
  std::vector<core::Quantity> truths_;  // values, then what the analogue sensors measure
  core::PlantDescription picture_;
  std::vector<std::size_t> measured_;  // sensors behind the truths after the values
  std::vector<std::int16_t> counts_;   // by sensor
  std::vector<double> numbers_;        // by truth
  std::vector<double> fresh_;          // sensors, then values, as the process has written them
  std::chrono::nanoseconds now_{0};
  std::unique_ptr<StepLink> link_;
};

}  // namespace stepwright::stepped
