// What a scan costs in which the missions of many vehicles run, on both engines, with the model predictive
// controller in C++ for the same vehicles beside it.
//
//   bench_fleet_scan [--vehicles N] [--json FILE]      default: 20 vehicles

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "ladder/driver/compile.h"
#include "plant_models/assemblies/fleet_floor.h"
#include "plant_models/bridge/plant_driver.h"
#include "supervisor/fleet/control/path_follower.h"
#include "supervisor/fleet/program/fleet_program.h"
#include "tests/support/lock_step/host_machine.h"
#include "tests/unit/supervisor/fleet/control/made_path.h"

namespace stepwright::bench {
namespace {

using namespace fleet;
using Clock = std::chrono::steady_clock;

constexpr int kScans = 1'500;  // of 20 ms
constexpr double kLane_m = 12.0;

double microseconds(Clock::duration time) {
  return std::chrono::duration<double, std::micro>(time).count();
}

struct Costs {
  std::vector<double> us;

  double mean() const {
    double sum = 0.0;
    for (const double each : us) sum += each;
    return sum / static_cast<double>(us.size());
  }
  double part(double share) {
    std::ranges::sort(us);
    return us[static_cast<std::size_t>(share * static_cast<double>(us.size() - 1))];
  }
};

// Each vehicle on a lane of its own, all of them in curves, in polygons of 4 m of way.
FleetPlan many_lanes(std::size_t vehicles) {
  FleetPlan plan;
  for (std::size_t v = 0; v < vehicles; ++v) {
    VehicleMission mission;
    const double y = kLane_m * static_cast<double>(v) - 0.5 * kLane_m * static_cast<double>(vehicles);
    mission.vehicle = fmt::format("v{}", v + 1);
    MadePath path({0.0, y, 0.0});
    for (int k = 0; k < 4; ++k) path.drive(4.0, 0.2).drive(8.0, -0.2).drive(4.0, 0.2);
    mission.path = path.path();
    const double end_m = mission.path.back().arc_m;
    for (double entry = 0.0; entry < end_m - 4.0; entry += 4.0) {
      const std::array<geometry::Point, 4> corners = {
          geometry::Point{-5.0, y - 5.0}, {80.0, y - 5.0}, {80.0, y + 5.0}, {-5.0, y + 5.0}};
      mission.grown.envelope.polygons.push_back({*geometry::ConvexPolygon::hull(corners), {}, {}});
      mission.grown.visits.push_back({0, 0, entry, std::min(end_m, entry + 6.0)});
    }
    mission.grown.visits.back().exit_m = end_m;
    set_times(mission.grown, {.min_mps = 0.0});
    plan.missions.push_back(std::move(mission));
  }
  plan.schedule = schedule(envelopes_of(plan), {}, {});
  return plan;
}

// The inputs of every scan, as the vehicles made them while the program drove them.
std::vector<std::vector<std::byte>> recorded_inputs(const FleetPlan& plan,
                                                    const std::vector<std::byte>& container) {
  assemblies::FleetParameters parameters;
  for (const VehicleMission& mission : plan.missions) {
    const geometry::Pose& at = mission.path.front().pose;
    parameters.starts.push_back({at.x_m, at.y_m, at.heading_rad});
  }
  auto floor = assemblies::FleetFloor::create(parameters).value();
  support::HostMachine machine(container, host::EngineKind::Native, 100'000'000);
  std::vector<std::byte> inputs(machine.image().inputs().size());
  auto driver = bridge::PlantDriver::create(*floor, bridge::default_fleet_wires(plan.missions.size()),
                                            {inputs.size(), machine.image().outputs().size()})
                    .value();
  std::vector<std::vector<std::byte>> all;
  for (int scan = 0; scan < kScans; ++scan) {
    const std::int64_t now_ns = 20'000'000LL * scan;
    driver.read_inputs(now_ns, inputs);
    machine.scan(inputs);
    driver.write_outputs(now_ns, machine.image().outputs());
    all.push_back(inputs);
  }
  return all;
}

Costs scan_costs(const std::vector<std::byte>& container, host::EngineKind kind,
                 const std::vector<std::vector<std::byte>>& inputs) {
  support::HostMachine machine(container, kind, 100'000'000);
  Costs costs;
  for (const auto& each : inputs) {
    const auto start = Clock::now();
    machine.scan(each);
    costs.us.push_back(microseconds(Clock::now() - start));
  }
  return costs;
}

// One step of 0.1 s of all vehicles.
Costs controller_costs(const FleetPlan& plan) {
  std::vector<PathFollower> followers;
  std::vector<VehicleState> states;
  for (const VehicleMission& mission : plan.missions) {
    followers.push_back(PathFollower::create(mission.path, {}, {}, mission.model.footprint(), {}).value());
    const geometry::Pose& at = mission.path.front().pose;
    states.push_back({at.x_m, at.y_m, at.heading_rad, 0.0, 0.0});
  }
  Costs costs;
  for (int step = 0; step < kScans / 5; ++step) {
    const auto start = Clock::now();
    for (std::size_t v = 0; v < followers.size(); ++v) (void)followers[v].step(states[v], 0.1 * step, {});
    costs.us.push_back(microseconds(Clock::now() - start));
    for (std::size_t v = 0; v < followers.size(); ++v) states[v] = followers[v].prediction().states[1];
  }
  return costs;
}

int run(std::size_t vehicles, const char* json_file) {
  const FleetPlan plan = many_lanes(vehicles);
  const auto program = fleet_program(plan, terminals_in_a_row(vehicles), {});
  if (!program) return std::puts(result::to_string(program.error()).c_str()), 1;
  driver::CompileInput input;
  input.projects = {&program->project};
  const auto start = Clock::now();
  const auto compiled = driver::compile(input);
  const double compile_ms = 1e-3 * microseconds(Clock::now() - start);
  if (!compiled) return std::puts(result::to_string(compiled.error()).c_str()), 1;
  const auto inputs = recorded_inputs(plan, compiled->container);
  Costs native = scan_costs(compiled->container, host::EngineKind::Native, inputs);
  Costs vm = scan_costs(compiled->container, host::EngineKind::Vm, inputs);
  Costs controller = controller_costs(plan);
  nlohmann::json json = {{"vehicles", vehicles},
                         {"samples", program->figures.samples},
                         {"polygons", program->figures.polygons},
                         {"table_bytes", program->figures.table_bytes},
                         {"container_bytes", compiled->container.size()},
                         {"compile_ms", compile_ms},
                         {"native_scan_p50_us", native.part(0.5)},
                         {"native_scan_mean_us", native.mean()},
                         {"native_scan_p99_us", native.part(0.99)},
                         {"vm_scan_p50_us", vm.part(0.5)},
                         {"vm_scan_mean_us", vm.mean()},
                         {"vm_scan_p99_us", vm.part(0.99)},
                         {"controller_step_p50_us", controller.part(0.5)},
                         {"controller_step_mean_us", controller.mean()},
                         {"controller_step_p99_us", controller.part(0.99)}};
  std::puts(json.dump(2).c_str());
  if (json_file != nullptr) std::ofstream(json_file) << json.dump(2) << "\n";
  return 0;
}

}  // namespace
}  // namespace stepwright::bench

int main(int argc, char** argv) {
  std::size_t vehicles = 20;
  const char* json_file = nullptr;
  for (int k = 1; k + 1 < argc; k += 2) {
    if (std::strcmp(argv[k], "--vehicles") == 0) vehicles = std::strtoul(argv[k + 1], nullptr, 10);
    if (std::strcmp(argv[k], "--json") == 0) json_file = argv[k + 1];
  }
  return stepwright::bench::run(vehicles, json_file);
}
