#include "supervisor/fleet/executive/fleet_reading.h"

#include <string>

namespace stepwright::fleet {
namespace {

// Collects what is missing, so that all of it is said at once.
class Finder {
 public:
  explicit Finder(const reader::ProgramInfo& info) : info_(info) {}

  reader::Variable variable(const std::string& path) {
    const reader::Variable* found = info_.find(path);
    if (found != nullptr) return *found;
    lack("variable '" + path + "'");
    return {};
  }
  std::vector<reader::Variable> steps(const MissionProgram& mission) {
    std::vector<reader::Variable> bits;
    const reader::ChartInfo* chart = info_.chart(mission.program);
    if (chart == nullptr || chart->steps.size() != mission.steps.size()) {
      lack("chart '" + mission.program + "' of " + std::to_string(mission.steps.size()) + " steps");
      return bits;
    }
    for (const reader::StepInfo& step : chart->steps) bits.push_back(step.active);
    return bits;
  }
  result::Diagnostics take() { return std::move(problems_); }

 private:
  void lack(const std::string& what) {
    problems_.push_back({"X0002", result::Severity::Error, {}, "the program has no " + what, {}});
  }

  const reader::ProgramInfo& info_;
  result::Diagnostics problems_;
};

}  // namespace

result::Result<FleetReader> FleetReader::create(std::span<const std::byte> container,
                                                const FleetProgram& program) {
  auto info = reader::ProgramInfo::read(container);
  if (!info) return result::forward(info);
  Finder find(*info);
  FleetReader made;
  for (const MissionProgram& mission : program.missions) {
    const std::string& v = mission.name;
    const std::string vehicle = "vehicle_" + v + ".";
    made.vehicles_.push_back({.arc = find.variable("arc_" + v),
                              .areas = find.variable("areas_" + v),
                              .error = find.variable(vehicle + "ErrorID"),
                              .speed = find.variable(vehicle + "Speed"),
                              .standing = find.variable("standing_" + v),
                              .lifted = find.variable("lifted_" + v),
                              .lowered = find.variable("lowered_" + v),
                              .x = find.variable(vehicle + "X"),
                              .y = find.variable(vehicle + "Y"),
                              .heading = find.variable(vehicle + "Heading"),
                              .steps = find.steps(mission)});
  }
  made.estop_ok_ = find.variable("estop_ok");
  if (auto wrong = find.take(); !wrong.empty()) return tl::unexpected(std::move(wrong));
  return made;
}

FleetReading FleetReader::read(std::span<const std::byte> image) const {
  const auto number = [&](const reader::Variable& variable) { return reader::read_number(variable, image); };
  FleetReading reading;
  reading.emergency_stop = number(estop_ok_) == 0.0;
  for (const Vehicle& of : vehicles_) {
    VehicleReading now{.arc_m = number(of.arc),
                       .areas = static_cast<std::uint32_t>(number(of.areas)),
                       .error = static_cast<std::uint32_t>(number(of.error)),
                       .speed_m_s = number(of.speed),
                       .standing = number(of.standing) != 0.0,
                       .forks_at_end = number(of.lifted) != 0.0 || number(of.lowered) != 0.0,
                       .pose = {number(of.x), number(of.y), number(of.heading)},
                       .step = 0};
    for (std::size_t k = 0; k < of.steps.size(); ++k) {
      if (number(of.steps[k]) != 0.0) now.step = k;
    }
    reading.vehicles.push_back(now);
  }
  return reading;
}

}  // namespace stepwright::fleet
