#include <cmath>
#include <limits>
#include <string>

#include "plant_models/assemblies/bench_ports.h"
#include "plant_models/assemblies/port_target.h"
#include "plant_models/assemblies/tank_bench.h"

namespace stepwright::assemblies {
namespace {

constexpr std::string_view kBenchPlant = "the tank bench";

bool has_two_values(const FaultTarget& target) {
  return target.kind == FaultKind::StuckSwitch || target.kind == FaultKind::FrozenSensor;
}

bool allowed(const FaultTarget& target, double value) {
  if (has_two_values(target)) return value == 0.0 || value == 1.0;
  return value >= target.min && value <= target.max;
}

}  // namespace

core::FaultRange TankBench::fault_range(std::size_t fault) const {
  const FaultTarget target = bench_fault_target(fault);
  if (has_two_values(target)) return {};
  return {target.min, target.max, false};
}

result::Result<void> TankBench::inject_fault(std::string_view name, double value) {
  auto fault = find_fault(kBenchPlant, bench_faults(), name);
  if (!fault) return result::forward(fault);
  const FaultTarget target = bench_fault_target(*fault);
  if (!allowed(target, value)) {
    const core::Quantity& quantity = bench_faults()[*fault];
    const std::string unit = quantity.unit.empty() ? "" : " " + quantity.unit;
    const std::string range =
        has_two_values(target) ? "0 or 1" : number_text(target.min) + " to " + number_text(target.max) + unit;
    return result::fail("C0312", {},
                        "fault '" + quantity.name + "' cannot have the value " + number_text(value),
                        "allowed: " + range + "; " + quantity.meaning);
  }
  apply_fault(*fault, value, true);
  return {};
}

result::Result<void> TankBench::clear_fault(std::string_view name) {
  auto fault = find_fault(kBenchPlant, bench_faults(), name);
  if (!fault) return result::forward(fault);
  apply_fault(*fault, 0.0, false);
  return {};
}

void TankBench::apply_fault(std::size_t fault, double value, bool active) {
  const FaultTarget target = bench_fault_target(fault);
  const std::size_t i = target.index;
  BenchModes& modes = equations_.modes;
  switch (target.kind) {
    case FaultKind::Leak:
      modes.leak_m3_s[i] = value / 100.0 * equations_.capacity_m3(static_cast<Tank>(i));
      fault_changed_ = true;
      return;
    case FaultKind::WeakPump:
      modes.pump_strength[i] = active ? value : 1.0;
      fault_changed_ = true;
      return;
    case FaultKind::StuckSwitch:
      switch_faults_[i] = {active, value != 0.0};
      return;
    case FaultKind::SensorDrift:
      drift_faults_[i] = {value, now_};
      return;
    case FaultKind::FrozenSensor: {
      frozen_[i].reset();
      const auto reading = static_cast<std::uint32_t>(kLevelSensor + i);
      if (active && value != 0.0) frozen_[i] = sensor(core::SensorId(reading));
      return;
    }
    case FaultKind::ExtraDraw: {
      const double amount = value / 100.0 * equations_.capacity_m3(client_tank(i));
      const bool draws = active && amount > 0.0;
      modes.draw_until_m3[i] = draws ? y_[kDrawn + i] + amount : std::numeric_limits<double>::infinity();
      fault_changed_ = true;
      return;
    }
  }
}

}  // namespace stepwright::assemblies
