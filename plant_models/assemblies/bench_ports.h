#pragma once

// The terminals, truths and faults of the tank bench by name, and its description for viewers.
// Terminal names are those of paper 6, Tables 1 to 3.

#include <cstddef>
#include <cstdint>
#include <span>

#include "plant_models/assemblies/bench_parameters.h"
#include "plant_models/core/plant_description.h"
#include "plant_models/core/port.h"

namespace stepwright::assemblies {

// Indices of bench_actuators(): B1..B4 are 0..3 in the order of Pump.
inline constexpr std::size_t kDriveLeft = 4;
inline constexpr std::size_t kDriveRight = 5;
inline constexpr std::size_t kActuators = 6;

// Indices of bench_sensors(): the switches in the order of Place, then S1..S3.
inline constexpr std::size_t kLevelSensor = 3;
inline constexpr std::size_t kSensors = 6;

std::span<const core::Port> bench_actuators();
std::span<const core::Port> bench_sensors();

// Quantities of the truths, in the order of bench_truths().
enum class TruthKind : std::uint8_t {
  LevelPercent,  // of a tank
  Position,
  Speed,
  TotalLiquid,
  Sump,
  DeliveredPercent,  // to a client
  PumpSpeed,
  PumpFlow,
  OverflowFlow,  // of a tank
  LeakFlow,      // of all tanks together
};
struct TruthTarget {
  TruthKind kind = TruthKind::LevelPercent;
  std::size_t index = 0;  // of the tank, client or pump
};
std::span<const core::Quantity> bench_truths();
TruthTarget bench_truth_target(std::size_t truth);

// Kinds of faults in the order of bench_faults().
enum class FaultKind : std::uint8_t { Leak, WeakPump, StuckSwitch, SensorDrift, ExtraDraw, FrozenSensor };
struct FaultTarget {
  FaultKind kind = FaultKind::Leak;
  std::size_t index = 0;  // of the tank, pump, switch, level sensor or client
  double min = 0.0;       // allowed values
  double max = 0.0;
};
std::span<const core::Quantity> bench_faults();
FaultTarget bench_fault_target(std::size_t fault);

core::PlantDescription describe_bench(const BenchParameters& parameters);

}  // namespace stepwright::assemblies
