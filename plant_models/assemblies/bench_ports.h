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

// Indices of bench_truths(); where a kind has several, they follow each other.
enum class Truth : std::uint32_t {
  LevelPercent = 0,  // per Tank
  Position = 4,
  Speed = 5,
  TotalLiquid = 6,
  Sump = 7,
  DeliveredPercent = 8,  // per client
  PumpSpeed = 10,        // per Pump
  PumpFlow = 14,         // per Pump
  OverflowFlow = 18,     // per Tank but f1
  LeakFlow = 21,         // all tanks together
};
std::span<const core::Quantity> bench_truths();

// Kinds of faults in the order of bench_faults().
enum class FaultKind : std::uint8_t { Leak, WeakPump, StuckSwitch, SensorDrift, ExtraDraw };
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
