#include "tests/support/arms_program/arms_rig.h"

#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "cell/robot/robot_figures.h"
#include "ladder/driver/compile.h"
#include "runtime/ground/result/value_or_throw.h"
#include "runtime/scan/no_clock.h"
#include "runtime/scan/scan_cycle.h"

namespace stepwright::tamp::test {

namespace {

constexpr const char* kUrdf = STEPWRIGHT_SOURCE_DIR "/tests/cells/robot_cell/two_arms.urdf";

}  // namespace

std::vector<std::byte> compiled(const program::ArmsProgram& made) {
  driver::CompileInput input;
  input.projects = {&made.project};
  return result::value_or_throw(driver::compile(input)).container;
}

assemblies::RobotCellParameters plant_of(const scene::RobotCell& cell, const RigOptions& options) {
  assemblies::RobotCellParameters parameters;
  for (const scene::Furniture& each : cell.furniture)
    parameters.fixed.push_back(
        {each.name,
         assemblies::box_solid({each.form.size_x_m, each.form.size_y_m, each.form.height_m}),
         {assemblies::turn_upright(each.pose.angle_rad),
          {each.pose.x_m, each.pose.y_m, each.pose.z_m + 0.5 * each.form.height_m}},
         true,
         false});
  for (const scene::Thing& each : cell.things)
    parameters.objects.push_back(
        {each.name,
         each.name.starts_with("cup") ? assemblies::ObjectKind::Cup : assemblies::ObjectKind::Can,
         each.start.x_m,
         each.start.y_m,
         each.start.angle_rad,
         {2.0 * each.form.radius_m, 2.0 * each.form.radius_m, each.form.height_m},
         0.0});
  config::RobotCellPlantConfig robot;
  robot.robot = kUrdf;
  for (const scene::ArmModel& arm : cell.arms) {
    config::ArmConfig one;
    one.name = arm.name;
    one.tip = arm.name + "_tcp";
    one.gripper = arm.name + "_gripper";
    one.start_rad = arm.home;
    robot.arms.push_back(std::move(one));
  }
  if (auto read = cell_robot::read_robot(robot, parameters); !read)
    throw std::runtime_error(result::to_string(read.error()));
  parameters.blockages = options.blockages;
  parameters.camera.slots = options.slots;
  parameters.seed = options.seed;
  if (options.certain) assemblies::make_certain(parameters);
  return parameters;
}

ArmsRig::ArmsRig(const scene::RobotCell& cell, const RigOptions& options)
    : plant_(result::value_or_throw(assemblies::RobotCell::create(plant_of(cell, options)))),
      clock_(std::make_unique<scan::NoClock>()) {
  std::vector<std::string> arms;
  for (const scene::ArmModel& arm : cell.arms) arms.push_back(arm.name);
  const bridge::AreaSizes sizes{program::input_bytes_in_a_row(arms.size(), options.slots),
                                program::output_bytes_in_a_row(arms.size())};
  driver_ = result::value_or_throw(
      bridge::PlantDriver::create(*plant_, bridge::default_robot_cell_wires(arms, options.slots), sizes));
  areas_.emplace(*driver_, sizes.input_bytes, sizes.output_bytes);
  config_.engine = host::EngineKind::Native;
}

ArmsRig::~ArmsRig() = default;

void ArmsRig::load(const std::vector<std::byte>& container) {
  auto info = result::value_or_throw(reader::ProgramInfo::read(container));
  auto next =
      result::value_or_throw(host::PreparedProgram::create(container, "test", {*areas_, *clock_, config_}));
  if (program_ == nullptr) {
    next->cycle().start({});
  } else {
    const auto plan = result::value_or_throw(
        host::ChangePlan::make(*program_, *next, host::DownloadMode::ChangeRestartCharts));
    plan->carry(program_->image(), next->image());
    next->cycle().take_over(program_->cycle(), plan->tasks());
  }
  program_ = std::move(next);
  info_ = std::move(info);
}

void ArmsRig::scan() {
  if (program_->cycle().run_scan().state != scan::ScanState::Running)
    throw std::runtime_error("the program trapped");
}

bool ArmsRig::run(double until_s) {
  while (time_s() < until_s) {
    scan();
    const std::string at = step(program::kCellChart);
    if (at == "DONE") return true;
    if (!at.empty() && at != "START" && at != "POWER" && at != "RUN" && at != "HALT" && at != "OBSERVE")
      return false;
  }
  return false;
}

void ArmsRig::run_for(double seconds) {
  for (const double until_s = time_s() + seconds; time_s() < until_s;) scan();
}

std::string ArmsRig::step(const std::string& chart) const {
  const reader::ChartInfo* found = info_->chart(chart);
  if (found == nullptr) throw std::runtime_error("no chart " + chart);
  for (const reader::StepInfo& each : found->steps)
    if (reader::read_number(each.active, program_->image().bytes()) != 0.0) return each.name;
  return {};
}

const reader::Variable& ArmsRig::variable(const std::string& path) const {
  const reader::Variable* found = info_->find(path);
  if (found == nullptr) throw std::runtime_error("no variable " + path);
  return *found;
}

double ArmsRig::number(const std::string& path) const {
  return reader::read_number(variable(path), program_->image().bytes());
}

void ArmsRig::set_bool(const std::string& path, bool value) {
  program_->image().memory()[variable(path).address] = std::byte{value};
}

void ArmsRig::set_real(const std::string& path, double value) {
  std::memcpy(program_->image().memory().data() + variable(path).address, &value, sizeof value);
}

double ArmsRig::truth(const std::string& name) const {
  const auto found = core::find_truth(*plant_, name);
  if (!found) throw std::runtime_error("the plant has no quantity " + name);
  return plant_->truth(*found);
}

void ArmsRig::fault(const std::string& name, double value) {
  if (auto injected = plant_->inject_fault(name, value); !injected)
    throw std::runtime_error(result::to_string(injected.error()));
}

void ArmsRig::clear(const std::string& fault) {
  if (auto cleared = plant_->clear_fault(fault); !cleared)
    throw std::runtime_error(result::to_string(cleared.error()));
}

double ArmsRig::incidents() const {
  return static_cast<double>(plant_->judge().incidents().size());
}

std::string ArmsRig::incident_texts() const {
  std::string text;
  for (const assemblies::Incident& each : plant_->judge().incidents())
    text += plant_->judge().text(each) + "\n";
  return text;
}

}  // namespace stepwright::tamp::test
