#include "plant_models/stepped/stepped_plant.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "plant_models/core/names.h"

namespace stepwright::stepped {
namespace {

std::vector<core::Port> ports_of(const std::vector<SteppedTerminal>& terminals) {
  std::vector<core::Port> ports;
  for (const SteppedTerminal& each : terminals) ports.push_back({each.name, each.kind, each.meaning});
  return ports;
}

std::int16_t counts_of(const SteppedTerminal& terminal, double number) {
  if (terminal.kind == core::PortKind::Bool) return number != 0.0 ? 1 : 0;
  constexpr double kLow = std::numeric_limits<std::int16_t>::min();
  constexpr double kHigh = std::numeric_limits<std::int16_t>::max();
  return static_cast<std::int16_t>(
      std::clamp(std::round((number - terminal.at_zero) / terminal.per_count), kLow, kHigh));
}

}  // namespace

SteppedPlant::SteppedPlant(SteppedDescription description, StepCommand command)
    : about_(std::move(description)),
      command_(std::move(command)),
      actuator_ports_(ports_of(about_.actuators)),
      sensor_ports_(ports_of(about_.sensors)),
      truths_(about_.values),
      counts_(about_.sensors.size()) {
  picture_.name = about_.name;
  for (std::size_t i = 0; i < about_.sensors.size(); ++i) {
    const SteppedTerminal& sensor = about_.sensors[i];
    if (sensor.kind == core::PortKind::Bool) continue;
    measured_.push_back(i);
    truths_.push_back({sensor.name, sensor.unit, sensor.meaning});
    picture_.sensors.push_back(
        {sensor.name, sensor.unit, sensor.name, -sensor.at_zero / sensor.per_count, 1.0 / sensor.per_count});
  }
  numbers_.resize(truths_.size());
  fresh_.resize(about_.sensors.size() + about_.values.size());
}

result::Result<void> SteppedPlant::start() {
  auto link = StepLink::start({core::names_of(about_.actuators), core::names_of(about_.sensors),
                               core::names_of(about_.values), core::names_of(about_.faults)},
                              about_.seed, command_);
  if (!link) return result::forward(link);
  link_ = std::move(*link);
  // All actuators are off until the program says otherwise: 0 counts.
  for (std::uint32_t i = 0; i < about_.actuators.size(); ++i) set_actuator(core::ActuatorId(i), 0);
  if (!sample()) return result::fail("R0155", command_.where, link_->trouble());
  return {};
}

void SteppedPlant::set_actuator(core::ActuatorId id, std::int16_t value) {
  if (!link_) return;
  const SteppedTerminal& terminal = about_.actuators[id.value];
  const double number = terminal.kind == core::PortKind::Bool ? (value != 0 ? 1.0 : 0.0)
                                                              : terminal.at_zero + terminal.per_count * value;
  link_->area().set_actuator(id.value, number);
}

core::PlantStatus SteppedPlant::advance_to(std::chrono::nanoseconds time) {
  if (!link_) return core::PlantStatus::Good;
  while (now_ + about_.step <= time) {
    if (!link_->step((now_ + about_.step).count(), about_.step.count()) || !sample())
      return core::PlantStatus::Failed;
    now_ += about_.step;
  }
  return link_->failed() ? core::PlantStatus::Failed : core::PlantStatus::Good;
}

// All numbers or none: a plant that writes one that is none is lost with the state before.
bool SteppedPlant::sample() {
  const StepArea& area = link_->area();
  const std::size_t sensors = counts_.size();
  for (std::size_t i = 0; i < fresh_.size(); ++i) {
    fresh_[i] = i < sensors ? area.sensor(i) : area.value(i - sensors);
    if (std::isfinite(fresh_[i])) continue;
    link_->refuse_number(i < sensors ? about_.sensors[i].name : about_.values[i - sensors].name);
    return false;
  }
  for (std::size_t i = 0; i < sensors; ++i) counts_[i] = counts_of(about_.sensors[i], fresh_[i]);
  const std::size_t values = about_.values.size();
  for (std::size_t i = 0; i < values; ++i) numbers_[i] = fresh_[sensors + i];
  for (std::size_t i = 0; i < measured_.size(); ++i) numbers_[values + i] = fresh_[measured_[i]];
  return true;
}

result::Result<void> SteppedPlant::set_fault(std::string_view name, double value) {
  const auto index = core::index_of(about_.faults, name);
  if (!index) {
    return result::fail("C0311", {}, "the plant has no fault '" + std::string(name) + "'",
                        about_.faults.empty() ? "[plant.faults] lists those that it has"
                                              : core::known_names(about_.faults, name));
  }
  if (!std::isfinite(value)) {
    return result::fail("C0312", {},
                        "fault '" + std::string(name) + "' cannot have a value that is no number");
  }
  if (link_) link_->area().set_fault(*index, value);
  return {};
}

result::Result<void> SteppedPlant::inject_fault(std::string_view name, double value) {
  return set_fault(name, value);
}

result::Result<void> SteppedPlant::clear_fault(std::string_view name) {
  return set_fault(name, 0.0);
}

}  // namespace stepwright::stepped
