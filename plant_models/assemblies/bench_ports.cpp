#include "plant_models/assemblies/bench_ports.h"

#include <array>
#include <cassert>

namespace stepwright::assemblies {
namespace {

using core::Port;
using core::PortKind;
using core::Quantity;

constexpr double kMaxLeak = 100.0;     // percent/s
constexpr double kMaxDrift = 1000.0;   // counts/s
constexpr double kMaxDraw = 100000.0;  // percent

constexpr std::array<FaultTarget, 19> kFaultTargets = {{
    {FaultKind::Leak, index(Tank::F1), 0.0, kMaxLeak},
    {FaultKind::Leak, index(Tank::V1), 0.0, kMaxLeak},
    {FaultKind::Leak, index(Tank::A1), 0.0, kMaxLeak},
    {FaultKind::Leak, index(Tank::A2), 0.0, kMaxLeak},
    {FaultKind::WeakPump, index(Pump::B1), 0.0, 1.0},
    {FaultKind::WeakPump, index(Pump::B2), 0.0, 1.0},
    {FaultKind::WeakPump, index(Pump::B3), 0.0, 1.0},
    {FaultKind::WeakPump, index(Pump::B4), 0.0, 1.0},
    {FaultKind::StuckSwitch, 0, 0.0, 1.0},
    {FaultKind::StuckSwitch, 1, 0.0, 1.0},
    {FaultKind::StuckSwitch, 2, 0.0, 1.0},
    {FaultKind::SensorDrift, 0, -kMaxDrift, kMaxDrift},
    {FaultKind::SensorDrift, 1, -kMaxDrift, kMaxDrift},
    {FaultKind::SensorDrift, 2, -kMaxDrift, kMaxDrift},
    {FaultKind::ExtraDraw, 0, 0.0, kMaxDraw},
    {FaultKind::ExtraDraw, 1, 0.0, kMaxDraw},
    {FaultKind::FrozenSensor, 0, 0.0, 1.0},
    {FaultKind::FrozenSensor, 1, 0.0, 1.0},
    {FaultKind::FrozenSensor, 2, 0.0, 1.0},
}};

constexpr std::array<TruthTarget, 22> kTruthTargets = {{
    {TruthKind::LevelPercent, index(Tank::F1)},
    {TruthKind::LevelPercent, index(Tank::V1)},
    {TruthKind::LevelPercent, index(Tank::A1)},
    {TruthKind::LevelPercent, index(Tank::A2)},
    {TruthKind::Position},
    {TruthKind::Speed},
    {TruthKind::TotalLiquid},
    {TruthKind::Sump},
    {TruthKind::DeliveredPercent, 0},
    {TruthKind::DeliveredPercent, 1},
    {TruthKind::PumpSpeed, index(Pump::B1)},
    {TruthKind::PumpSpeed, index(Pump::B2)},
    {TruthKind::PumpSpeed, index(Pump::B3)},
    {TruthKind::PumpSpeed, index(Pump::B4)},
    {TruthKind::PumpFlow, index(Pump::B1)},
    {TruthKind::PumpFlow, index(Pump::B2)},
    {TruthKind::PumpFlow, index(Pump::B3)},
    {TruthKind::PumpFlow, index(Pump::B4)},
    {TruthKind::OverflowFlow, index(Tank::V1)},
    {TruthKind::OverflowFlow, index(Tank::A1)},
    {TruthKind::OverflowFlow, index(Tank::A2)},
    {TruthKind::LeakFlow},
}};

}  // namespace

// The lists below are built at the first call, which is at set-up and never in a scan.
std::span<const Port> bench_actuators() {
  static const std::array<Port, kActuators> kPorts = {{
      {"B1", PortKind::Bool, "loads v1 from f1, while the vehicle stands at f1"},
      {"B2", PortKind::Bool, "unloads v1 into the distributor below it, else onto the floor"},
      {"B3", PortKind::Bool, "client c1 draws from a1; the return line leads to f1"},
      {"B4", PortKind::Bool, "client c2 draws from a2; the return line leads to f1"},
      {"drive_left", PortKind::Bool, "drives the vehicle towards a1; both directions at once brake"},
      {"drive_right", PortKind::Bool, "drives the vehicle towards a2; both directions at once brake"},
  }};
  return kPorts;
}

std::span<const Port> bench_sensors() {
  static const std::array<Port, kSensors> kPorts = {{
      {"fc1", PortKind::Bool, "the vehicle stands at the supplier f1"},
      {"fc2", PortKind::Bool, "the vehicle stands at the distributor a1"},
      {"fc3", PortKind::Bool, "the vehicle stands at the distributor a2"},
      {"S1", PortKind::Count, "level of the vehicle's tank v1"},
      {"S2", PortKind::Count, "level of the distributor a1"},
      {"S3", PortKind::Count, "level of the distributor a2"},
  }};
  return kPorts;
}

std::span<const Quantity> bench_truths() {
  static const std::array<Quantity, kTruthTargets.size()> kTruths = {{
      {"level_f1_percent", "percent", "level of the supplier"},
      {"level_v1_percent", "percent", "level of the vehicle's tank"},
      {"level_a1_percent", "percent", "level of the distributor a1"},
      {"level_a2_percent", "percent", "level of the distributor a2"},
      {"position", "m", "position of the vehicle: a1 -1, f1 0, a2 +1"},
      {"speed", "m/s", "speed of the vehicle, positive to the right"},
      {"total_liquid", "l", "all liquid, sump included: constant"},
      {"sump", "l", "liquid spilt or leaked so far"},
      {"delivered_c1_percent", "percent", "liquid drawn by client c1 so far; 10 percent = one plan level"},
      {"delivered_c2_percent", "percent", "liquid drawn by client c2 so far; 10 percent = one plan level"},
      {"speed_b1", "", "speed of pump B1; 1 = nominal"},
      {"speed_b2", "", "speed of pump B2; 1 = nominal"},
      {"speed_b3", "", "speed of pump B3; 1 = nominal"},
      {"speed_b4", "", "speed of pump B4; 1 = nominal"},
      {"flow_b1", "l/s", "flow of pump B1"},
      {"flow_b2", "l/s", "flow of pump B2"},
      {"flow_b3", "l/s", "flow of pump B3"},
      {"flow_b4", "l/s", "flow of pump B4"},
      {"overflow_v1", "l/s", "overflow of v1 to f1"},
      {"overflow_a1", "l/s", "overflow of a1 to f1"},
      {"overflow_a2", "l/s", "overflow of a2 to f1"},
      {"leak", "l/s", "all leaks together, to the sump"},
  }};
  return kTruths;
}

std::span<const Quantity> bench_faults() {
  static const std::array<Quantity, kFaultTargets.size()> kFaults = {{
      {"leak_f1", "percent/s", "f1 leaks to the sump at this rate while it holds liquid"},
      {"leak_v1", "percent/s", "v1 leaks to the sump at this rate while it holds liquid"},
      {"leak_a1", "percent/s", "a1 leaks to the sump at this rate while it holds liquid"},
      {"leak_a2", "percent/s", "a2 leaks to the sump at this rate while it holds liquid"},
      {"weak_b1", "", "B1 delivers this share of its flow"},
      {"weak_b2", "", "B2 delivers this share of its flow"},
      {"weak_b3", "", "B3 delivers this share of its flow"},
      {"weak_b4", "", "B4 delivers this share of its flow"},
      {"stuck_fc1", "", "fc1 shows 0 or 1 whatever the vehicle does"},
      {"stuck_fc2", "", "fc2 shows 0 or 1 whatever the vehicle does"},
      {"stuck_fc3", "", "fc3 shows 0 or 1 whatever the vehicle does"},
      {"drift_s1", "counts/s", "S1 drifts away from its present reading at this rate"},
      {"drift_s2", "counts/s", "S2 drifts away from its present reading at this rate"},
      {"drift_s3", "counts/s", "S3 drifts away from its present reading at this rate"},
      {"draw_c1", "percent", "c1 takes this much from a1 with B3, whatever the output says"},
      {"draw_c2", "percent", "c2 takes this much from a2 with B4, whatever the output says"},
      {"frozen_s1", "", "1: S1 goes on showing its present reading"},
      {"frozen_s2", "", "1: S2 goes on showing its present reading"},
      {"frozen_s3", "", "1: S3 goes on showing its present reading"},
  }};
  return kFaults;
}

TruthTarget bench_truth_target(std::size_t truth) {
  assert(truth < kTruthTargets.size());
  return kTruthTargets[truth];
}

FaultTarget bench_fault_target(std::size_t fault) {
  assert(fault < kFaultTargets.size());
  return kFaultTargets[fault];
}

core::PlantDescription describe_bench(const BenchParameters& p) {
  core::PlantDescription d;
  d.name = "tank bench";
  const auto& at = p.track.position_m;
  const auto tank = [&](Tank t) { return p.tanks[index(t)].capacity_l; };
  d.tanks = {
      {"f1", "Supplier f1", tank(Tank::F1), 100.0, at[0], "", "level_f1_percent", ""},
      {"v1", "Vehicle v1", tank(Tank::V1), 100.0, p.vehicle.initial_position_m, "v1", "level_v1_percent",
       "S1"},
      {"a1", "Distributor a1", tank(Tank::A1), 100.0, at[1], "", "level_a1_percent", "S2"},
      {"a2", "Distributor a2", tank(Tank::A2), 100.0, at[2], "", "level_a2_percent", "S3"},
  };
  d.pumps = {{"b1", "B1", "speed_b1", "flow_b1"},
             {"b2", "B2", "speed_b2", "flow_b2"},
             {"b3", "B3", "speed_b3", "flow_b3"},
             {"b4", "B4", "speed_b4", "flow_b4"}};
  d.pipes = {{"f1", "v1", "b1", "f1"}, {"v1", "a1", "b2", "a1"}, {"v1", "a2", "b2", "a2"},
             {"a1", "f1", "b3", ""},   {"a2", "f1", "b4", ""},   {"v1", "f1", "", ""},
             {"a1", "f1", "", ""},     {"a2", "f1", "", ""}};
  const double half_width = p.track.switch_half_width_m;
  d.vehicles = {{"v1",
                 "position",
                 "speed",
                 "drive_left",
                 "drive_right",
                 -p.track.end_stop_m,
                 p.track.end_stop_m,
                 {{"f1", at[0], half_width, "fc1"},
                  {"a1", at[1], half_width, "fc2"},
                  {"a2", at[2], half_width, "fc3"}}}};
  const std::array<const char*, kLevelSensors> measures = {"level_v1_percent", "level_a1_percent",
                                                           "level_a2_percent"};
  for (std::size_t i = 0; i < kLevelSensors; ++i) {
    const LevelCalibration& c = p.calibration[i];
    d.sensors.push_back({bench_sensors()[kLevelSensor + i].name, "percent", measures[i], c.counts(0.0),
                         c.counts_per_percent()});
  }
  return d;
}

}  // namespace stepwright::assemblies
