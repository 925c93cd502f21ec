#include "bench_rig.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace stepwright::translate::testing {

namespace {

constexpr double kScan_s = 0.01;
constexpr double kVehicleSpeed = 0.25;
constexpr double kSwitchWidth = 0.03;

}  // namespace

BenchRig::BenchRig(const Translation& translation, const Binding& binding, const Tare& bias)
    : translation_(translation), binding_(binding), bias_(bias), chart_(translation.chart()) {}

double BenchRig::input(const std::string& name) const {
  if (const auto fixed = stuck.find(name); fixed != stuck.end()) return fixed->second;
  if (name == "fc1") return std::abs(position) < kSwitchWidth;
  if (name == "fc2") return std::abs(position + 1.0) < kSwitchWidth;
  if (name == "fc3") return std::abs(position - 1.0) < kSwitchWidth;
  for (const Sensor& sensor : binding_.sensors) {
    if (name != filtered_variable(sensor)) continue;
    return sensor.calibration.counts_at(levels.at(sensor.fluent)) + tare_of(bias_, sensor);
  }
  throw std::invalid_argument("the chart reads '" + name + "'");
}

bool BenchRig::output(const std::string& name) const {
  for (std::size_t i = 0; i < translation_.steps.size(); ++i) {
    for (const graphic::ActionBlock& block : translation_.chart().steps[i].actions) {
      if (block.target == name && chart_.active(i)) return true;
    }
  }
  return false;
}

void BenchRig::pump(const std::string& name, double amount) {
  if (name == "B1") levels["(lev v1)"] += amount;
  if (name == "B2") {
    levels["(lev v1)"] -= amount;
    levels[position < 0.0 ? "(level a1)" : "(level a2)"] += amount;
  }
  if (name == "B3") levels["(level a1)"] -= amount / 2.0;
  if (name == "B4") levels["(level a2)"] -= amount / 2.0;
}

void BenchRig::move_plant() {
  for (const char* name : {"B1", "B2", "B3", "B4"}) {
    const bool on = output(name);
    if (on) pump(name, pump_speed * kScan_s);
    if (!on && pumping_[name]) pump(name, run_out);
    pumping_[name] = on;
  }
  if (output("drive_left")) position -= kVehicleSpeed * kScan_s;
  if (output("drive_right")) position += kVehicleSpeed * kScan_s;
  position = std::clamp(position, -1.05, 1.05);
}

void BenchRig::scan() {
  chart_.scan(scans_ * 10'000'000L, [this](const std::string& name) { return std::llround(input(name)); });
  ++scans_;
  move_plant();
}

bool BenchRig::active(const std::string& step) const {
  return chart_.active(translation_.step(step).value());
}

std::vector<bool> BenchRig::active_steps() const {
  std::vector<bool> flags;
  for (std::size_t i = 0; i < translation_.steps.size(); ++i) flags.push_back(chart_.active(i));
  return flags;
}

std::string BenchRig::run(double seconds) {
  const double end = time_s() + seconds;
  while (time_s() < end) {
    scan();
    for (std::size_t i = 0; i < translation_.steps.size(); ++i) {
      const StepKind kind = translation_.steps[i].kind;
      const bool last = kind == StepKind::Done || kind == StepKind::Failed;
      if (last && chart_.active(i)) return translation_.steps[i].name;
    }
  }
  return "";
}

}  // namespace stepwright::translate::testing
