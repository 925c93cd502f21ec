#include "tests/support/fleet_program/fleet_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "ladder/driver/compile.h"
#include "runtime/bytecode/reader/read_value.h"
#include "runtime/ground/result/value_or_throw.h"
#include "tests/support/fleet/exact_outline.h"

namespace stepwright::fleet {
namespace {

constexpr std::uint64_t kBudget = 100'000'000;
constexpr int kJudgeEvery = 5;  // scans

assemblies::FleetParameters floor_of(const FleetPlan& plan, const RigOptions& options) {
  assemblies::FleetParameters parameters;
  for (const VehicleMission& mission : plan.missions) {
    const geometry::Pose& start = mission.path.front().pose;
    parameters.starts.push_back({start.x_m, start.y_m, start.heading_rad});
  }
  parameters.pallets = options.pallets;
  parameters.seed = options.seed;
  return parameters;
}

bool is_interlock(const graphic::Condition& condition) {
  return condition.kind == graphic::ConditionKind::Comparison && condition.name.starts_with("areas_");
}

}  // namespace

void remove_interlocks(FleetProgram& program) {
  for (graphic::Pou& pou : program.project.pous) {
    auto* chart = std::get_if<graphic::SfcChart>(&pou.body);
    if (chart == nullptr) continue;
    for (graphic::Transition& transition : chart->transitions) {
      auto& condition = transition.condition;
      std::erase_if(condition.children, is_interlock);
    }
  }
}

FleetRig::FleetRig(const FleetPlan& plan, const RigOptions& options) : plan_(plan), options_(options) {
  const FleetTerminals terminals = terminals_in_a_row(plan.missions.size());
  program_ = result::value_or_throw(fleet_program(plan, terminals, options.program));
  if (!options.interlocks) remove_interlocks(program_);
  driver::CompileInput input;
  input.projects = {&program_.project};
  auto compiled = result::value_or_throw(driver::compile(input));
  info_ = result::value_or_throw(reader::ProgramInfo::read(compiled.container));
  vm_ = std::make_unique<support::HostMachine>(compiled.container, host::EngineKind::Vm, kBudget);
  if (options.native) {
    native_ = std::make_unique<support::HostMachine>(compiled.container, host::EngineKind::Native, kBudget);
  }
  floor_ = result::value_or_throw(assemblies::FleetFloor::create(floor_of(plan, options)));
  inputs_.resize(vm_->image().inputs().size());
  const auto wires = bridge::default_fleet_wires(plan.missions.size());
  driver_ = result::value_or_throw(
      bridge::PlantDriver::create(*floor_, wires, {inputs_.size(), vm_->image().outputs().size()}));
  for (const MissionProgram& mission : program_.missions) {
    const std::string vehicle = "vehicle_" + mission.name;
    watched_.push_back({variable("done_" + mission.name), variable(vehicle + ".Arc"),
                        variable("permitted_" + mission.name), variable(vehicle + ".Deviation")});
  }
  arrival_s.resize(plan.missions.size());
  most_deviation_m.resize(plan.missions.size());
}

void FleetRig::scan() {
  driver_->read_inputs(now_ns_, inputs_);
  const scan::ScanReport report = vm_->scan(inputs_);
  if (report.state != scan::ScanState::Running) throw std::runtime_error("the program trapped");
  if (native_ && native_->scan(inputs_).image_hash != report.image_hash) engines_agree = false;
  driver_->write_outputs(now_ns_, vm_->image().outputs());
  now_ns_ += 1'000 * options_.program.interval_us;
  for (std::size_t v = 0; v < plan_.missions.size(); ++v) watch(v);
  if (report.scan % kJudgeEvery == 0) judge();
}

void FleetRig::run(double until_s) {
  while (time_s() < until_s && !all_arrived()) scan();
}

bool FleetRig::all_arrived() const {
  for (std::size_t v = 0; v < plan_.missions.size(); ++v) {
    if (!arrived(v)) return false;
  }
  return true;
}

void FleetRig::watch(std::size_t vehicle) {
  const Watched& watched = watched_[vehicle];
  if (arrival_s[vehicle] == 0.0 && arrived(vehicle)) arrival_s[vehicle] = time_s();
  most_overrun_m = std::max(most_overrun_m, value(watched.arc) - value(watched.permitted));
  most_deviation_m[vehicle] = std::max(most_deviation_m[vehicle], std::abs(value(watched.deviation)));
}

reader::Variable FleetRig::variable(const std::string& path) const {
  const reader::Variable* found = info_->find(path);
  if (found == nullptr) throw std::runtime_error("no variable " + path);
  return *found;
}

double FleetRig::value(const reader::Variable& variable) const {
  return reader::read_number(variable, vm_->image().memory());
}

void FleetRig::set(const std::string& path, bool value) {
  const std::uint32_t address = variable(path).address;
  for (support::HostMachine* machine : {vm_.get(), native_.get()}) {
    if (machine != nullptr) machine->image().memory()[address] = std::byte{value};
  }
}

geometry::Pose FleetRig::pose(std::size_t vehicle) const {
  const assemblies::ForkliftPose at = floor_->vehicle_pose(vehicle);
  return {at.x_m, at.y_m, at.heading_rad};
}

void FleetRig::fault(const std::string& name, double value) {
  if (auto injected = floor_->inject_fault(name, value); !injected) {
    throw std::runtime_error(result::to_string(injected.error()));
  }
}

std::string FleetRig::state() const {
  std::string text = fmt::format("at {:.1f} s\n", time_s());
  for (std::size_t v = 0; v < plan_.missions.size(); ++v) {
    text += fmt::format(
        "  {}: arc {:.2f} of {:.2f}, permitted {:.2f}, area {}, left {}, error {} at {:.2f}, speed {:.2f}, "
        "deviation {:.2f} (most {:.2f}), state {}\n",
        name(v), of("Arc", v), plan_.missions[v].path.back().arc_m, number("permitted_" + name(v)),
        of("Area", v), of("Areas", v), of("ErrorID", v), of("ErrorArc", v), of("Speed", v),
        of("Deviation", v), most_deviation_m[v], of("State", v));
  }
  return text + first_fault;
}

void FleetRig::judge() {
  std::vector<geometry::ConvexPolygon> outlines;
  for (std::size_t v = 0; v < plan_.missions.size(); ++v) {
    outlines.push_back(footprint_at(pose(v), plan_.missions[v].model.footprint()));
    if (options_.grid != nullptr &&
        support::outline_hits(*options_.grid, plan_.missions[v].model.footprint(), pose(v))) {
      if (wall_hits++ == 0) first_fault += fmt::format("{} hits a wall at {:.2f} s\n", name(v), time_s());
    }
    for (std::size_t other = 0; other < v; ++other) {
      if (!geometry::overlaps(outlines[v], outlines[other])) continue;
      if (overlaps++ == 0)
        first_fault += fmt::format("{} and {} overlap at {:.2f} s\n", name(other), name(v), time_s());
    }
  }
}

}  // namespace stepwright::fleet
