#pragma once

// A simulated plant: terminals, a clock of its own, faults that can be injected, and its true state.
//
// Thread rule: one thread at a time; the scan thread while a scan runs. `set_actuator`, `advance_to`,
// `sensor` and `truth` allocate nothing and never throw, so that a scan may call them; the calls that take
// a name are for set-up, for faults and for reports.
// Invariants: time never runs backwards; the lists of ports, truths and faults never change; the same
// options, seed and calls give bit-identical sensor values.
//
//   plant.set_actuator(*find_actuator(plant, "B1"), true);
//   if (plant.advance(std::chrono::milliseconds(10)) != PlantStatus::Good) ...
//   std::int16_t counts = plant.sensor(*find_sensor(plant, "S1"));

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "plant_models/core/plant_description.h"
#include "plant_models/core/port.h"
#include "runtime/ground/result/result.h"

namespace stepwright::core {

enum class PlantStatus : std::uint8_t {
  Good,
  Failed,  // the solver gave up; the state stays where it was, for good
};

class Plant {
 public:
  virtual ~Plant() = default;

  virtual std::span<const Port> actuators() const = 0;
  virtual std::span<const Port> sensors() const = 0;
  virtual std::span<const Quantity> truths() const = 0;
  virtual std::span<const Quantity> faults() const = 0;
  // Values of a fault that happen to plants of the kind, all of which it can have: what a campaign tries.
  virtual FaultRange fault_range(std::size_t fault) const {
    (void)fault;
    return {};
  }
  virtual const PlantDescription& description() const = 0;

  // Simulated time since the plant was made.
  virtual std::chrono::nanoseconds now() const = 0;

  // Commands an actuator at now(); it holds until the next call. 0 or 1 (true), or raw counts, as its port
  // says.
  virtual void set_actuator(ActuatorId id, std::int16_t value) = 0;

  // Runs the plant up to `time`; a time that has passed already changes nothing.
  virtual PlantStatus advance_to(std::chrono::nanoseconds time) = 0;

  PlantStatus advance(std::chrono::nanoseconds step) { return advance_to(now() + step); }

  // Value of the terminal at now(): 0 or 1, or raw counts.
  virtual std::int16_t sensor(SensorId id) const = 0;

  // The true state at now(), which no controller may read: for reports and viewers.
  virtual double truth(TruthId id) const = 0;

  // Starts the processes that it is made of, if it is. Without them it has its terminals and faults, and does
  // not move: enough to check a cell. Fails with R0151 to R0155.
  [[nodiscard]] virtual result::Result<void> start() { return {}; }

  // It cannot go on. Any thread.
  virtual bool failed() const { return false; }

  // Why it cannot go on, in one sentence; empty while it can. A process of it that is lost is ended. The
  // thread that started it.
  virtual std::string trouble() { return {}; }

  // What has happened up to now() that must not, whoever controls the plant: vehicles that met, liquid that
  // came from nowhere. Empty: nothing. For reports.
  virtual std::string violation() const { return {}; }

  // Makes the named fault hold from now() on, with a value in the fault's unit; injecting it again replaces
  // the value. Fails with C0311 (no such fault; the hint lists the known ones) or C0312 (value out of range)
  // and then changes nothing.
  [[nodiscard]] virtual result::Result<void> inject_fault(std::string_view name, double value) = 0;

  // Ends the named fault; what it did to the state stays. Fails with C0311.
  [[nodiscard]] virtual result::Result<void> clear_fault(std::string_view name) = 0;

  // State for another process to continue the simulation from here: kept_size() numbers (a constant), in an
  // order of the plant's own. Faults and terminals are not among them. No heap, as for `truth`.
  virtual std::size_t kept_size() const = 0;
  virtual void keep(std::span<double> numbers) const = 0;
};

// Look-up by name, upper and lower case alike; nothing if the plant has no such port or truth.
std::optional<ActuatorId> find_actuator(const Plant& plant, std::string_view name);
std::optional<SensorId> find_sensor(const Plant& plant, std::string_view name);
std::optional<TruthId> find_truth(const Plant& plant, std::string_view name);

}  // namespace stepwright::core
