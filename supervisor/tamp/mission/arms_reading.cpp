#include "supervisor/tamp/mission/arms_reading.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

namespace stepwright::tamp::mission {
namespace {

constexpr double kPlace_m = 1e-4, kAngle_rad = 1e-4;  // of the camera's counts

}  // namespace

result::Result<ArmsReader> ArmsReader::create(std::span<const std::byte> container,
                                              const scene::RobotCell& cell,
                                              const program::ArmsVariables& variables) {
  auto info = reader::ProgramInfo::read(container);
  if (!info) return result::forward(info);
  result::Diagnostics missing;
  const auto lack = [&](const std::string& what) {
    missing.push_back({"X0002", result::Severity::Error, {}, "the program has no " + what, {}});
  };
  const auto find = [&](const std::string& path) {
    const reader::Variable* found = info->find(path);
    if (found == nullptr) lack("variable '" + path + "'");
    return found == nullptr ? reader::Variable{} : *found;
  };
  ArmsReader made;
  for (std::size_t arm = 0; arm < cell.arms.size(); ++arm) {
    const program::ArmVariables& names = variables.arms[arm];
    Arm one;
    for (std::size_t j = 0; j < one.joints.size(); ++j) one.joints[j] = find(names.joints[j]);
    one.width = find(names.width);
    one.progress = find(names.progress);
    one.error = find(names.error);
    one.failed_joint = find(names.failed_joint);
    one.failed_at = find(names.failed_at);
    one.failed_by = find(names.failed_by);
    one.waiting = find(names.waiting);
    one.grasp_switch = find(names.grip_seen);
    made.arms_.push_back(std::move(one));
  }
  const program::CameraVariables& camera = variables.camera;
  const std::size_t slots = camera.kind.size();
  for (std::size_t s = 0; s < slots; ++s)
    made.slots_.push_back(
        {find(camera.kind[s]), find(camera.x[s]), find(camera.y[s]), find(camera.z[s]), find(camera.yaw[s])});
  for (std::size_t report = 0; report < camera.kept; ++report) {
    std::vector<Slot> row;
    for (std::size_t s = 0; s < slots; ++s) {
      const std::string at = "[" + std::to_string(report * slots + s) + "]";
      row.push_back({find(camera.all_kind + at), find(camera.all_x + at), find(camera.all_y + at),
                     find(camera.all_z + at), find(camera.all_yaw + at)});
    }
    made.kept_.push_back(std::move(row));
  }
  made.cause_ = find(variables.cause);
  made.cause_arm_ = find(variables.cause_arm);
  made.rest_ = find(variables.rest);
  made.estop_ok_ = find("estop_ok");
  made.reports_ = find(camera.reports);
  const reader::ChartInfo* chart = info->chart(program::kCellChart);
  if (chart == nullptr) {
    lack(std::string("chart '") + program::kCellChart + "'");
  } else {
    static constexpr std::string_view kBegins[] = {"START", "POWER"};
    static constexpr std::string_view kWorks[] = {"RUN", "HALT", "OBSERVE"};
    for (const reader::StepInfo& step : chart->steps) {
      if (step.name == "DONE")
        made.done_ = step.active;
      else if (std::ranges::find(kWorks, step.name) != std::end(kWorks))
        made.works_ = step.active;
      else if (std::ranges::find(kBegins, step.name) == std::end(kBegins))
        made.stopped_.push_back(step.active);
    }
  }
  if (!missing.empty()) return tl::unexpected(std::move(missing));
  return made;
}

ArmsReading ArmsReader::read(std::span<const std::byte> image) const {
  const auto number = [&](const reader::Variable& variable) { return reader::read_number(variable, image); };
  const auto on = [&](const reader::Variable& variable) { return number(variable) != 0.0; };
  ArmsReading now;
  for (const Arm& each : arms_) {
    ArmReading arm;
    for (std::size_t j = 0; j < arm.joints.size(); ++j) arm.joints[j] = number(each.joints[j]);
    arm.width_m = number(each.width);
    arm.progress = number(each.progress);
    arm.error = static_cast<int>(number(each.error));
    arm.failed_joint = static_cast<int>(std::clamp(number(each.failed_joint), 0.0, 7.0));
    arm.failed_at_rad = number(each.failed_at);
    arm.failed_by_rad = number(each.failed_by);
    arm.waiting = on(each.waiting);
    arm.grasp_switch = on(each.grasp_switch);
    now.arms.push_back(arm);
  }
  const auto last = static_cast<double>(program::StopCause::Fingers);
  now.cause = static_cast<program::StopCause>(static_cast<int>(std::clamp(number(cause_), 0.0, last)));
  now.cause_arm = static_cast<int>(number(cause_arm_)) - 1;
  now.rest = on(rest_);
  now.estop_ok = on(estop_ok_);
  now.reports = static_cast<int>(number(reports_));
  if (on(done_)) now.stage = CellStage::Done;
  if (on(works_)) now.stage = CellStage::Works;
  if (std::ranges::any_of(stopped_, on)) now.stage = CellStage::Stopped;
  return now;
}

Seen ArmsReader::seen(const Slot& slot, std::span<const std::byte> image) {
  const auto number = [&](const reader::Variable& variable) { return reader::read_number(variable, image); };
  return {static_cast<int>(number(slot.kind)),
          {kPlace_m * number(slot.x), kPlace_m * number(slot.y), kPlace_m * number(slot.z),
           kAngle_rad * number(slot.yaw)}};
}

Report ArmsReader::newest(std::span<const std::byte> image) const {
  Report report;
  for (const Slot& each : slots_)
    if (const Seen found = seen(each, image); found.kind != 0) report.push_back(found);
  return report;
}

std::vector<Report> ArmsReader::all(std::span<const std::byte> image) const {
  std::vector<Report> reports;
  for (const std::vector<Slot>& row : kept_) {
    Report report;
    for (const Slot& each : row)
      if (const Seen found = seen(each, image); found.kind != 0) report.push_back(found);
    reports.push_back(std::move(report));
  }
  return reports;
}

}  // namespace stepwright::tamp::mission
