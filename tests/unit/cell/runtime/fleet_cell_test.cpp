// The cell's configuration, its map, plant and wires, with a program that was planned for them: all that the
// runtime process does, in one thread.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <stdexcept>

#include "cell/runtime/cell_io.h"
#include "ladder/driver/compile.h"
#include "supervisor/fleet/program/fleet_program.h"
#include "supervisor/map/map_file.h"
#include "tests/support/fleet_program/planned_fleet.h"
#include "tests/support/lock_step/host_machine.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::cell_runtime {
namespace {

constexpr const char* kCell = STEPWRIGHT_SOURCE_DIR "/tests/cells/fleet/small_hall.toml";

fleet::FleetPlan plan_for(const config::PlantConfig& plant) {
  const geometry::Pose goals[] = {
      {32.0, 20.0, 0.5 * std::numbers::pi}, {18.0, 12.0, std::numbers::pi}, {18.0, 20.0, 0.0}};
  std::vector<fleet::DrawnMission> missions;
  for (std::size_t v = 0; v < plant.fleet.vehicles.size(); ++v) {
    const config::PlaceConfig& place = plant.fleet.vehicles[v];
    const geometry::Pose start{place.x_m, place.y_m, place.heading_deg * std::numbers::pi / 180.0};
    missions.push_back({start, {goals[v]}});
  }
  return fleet::plan_missions(fleet::read_map(plant.fleet.map).value(), missions);
}

TEST(FleetCell, WhenAPlanForItIsRun_ThenItsVehiclesArriveWithoutAContact) {
  const support::TemporaryFolder folder;
  const auto config = config::load_cell_config(kCell, {"cell.state_dir=" + folder.path().string()});
  ASSERT_TRUE(config) << result::to_string(config.error());
  const fleet::FleetPlan plan = plan_for(config->plant);
  fleet::ProgramOptions options;
  options.interval_us = config->clock.interval_us;
  auto program = fleet::fleet_program(plan, fleet::terminals_in_a_row(3), options);
  ASSERT_TRUE(program) << result::to_string(program.error());
  auto compiled = driver::compile({.texts = {}, .projects = {&program->project}});
  ASSERT_TRUE(compiled) << result::to_string(compiled.error());
  auto io = CellIo::create(*config);
  ASSERT_TRUE(io) << result::to_string(io.error());
  support::HostMachine machine(std::move(compiled->container), host::EngineKind::Auto, 100'000'000);
  // Areas of the cell's sizes, as the runtime has them; the program uses less.
  std::vector<std::byte> inputs(config->image.input_bytes);
  std::vector<std::byte> outputs(config->image.output_bytes);
  const std::size_t used = machine.image().inputs().size();
  for (int scan = 0; scan < 6'000; ++scan) {
    const std::int64_t now_ns = 20'000'000LL * scan;
    ASSERT_EQ((*io)->driver().read_inputs(now_ns, inputs), image::IoStatus::Good);
    ASSERT_EQ(machine.scan(std::span(inputs).first(used)).state, scan::ScanState::Running);
    std::ranges::copy(machine.image().outputs(), outputs.begin());
    ASSERT_EQ((*io)->driver().write_outputs(now_ns, outputs), image::IoStatus::Good);
  }
  host::PlantAccess& plant = *(*io)->plant();
  std::vector<double> values(plant.value_names().size());
  plant.read_values(values);
  const auto truth = [&](const std::string& name) {
    const auto names = plant.value_names();
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) throw std::runtime_error("no value " + name);
    return values[static_cast<std::size_t>(found - names.begin())];
  };
  EXPECT_EQ(truth("contacts"), 0.0);
  for (std::size_t v = 0; v < 3; ++v) {
    const std::string name = "v" + std::to_string(v + 1);
    EXPECT_NEAR(truth("true_x_" + name), plan.missions[v].path.back().pose.x_m, 0.12) << name;
    EXPECT_NEAR(truth("true_y_" + name), plan.missions[v].path.back().pose.y_m, 0.12) << name;
  }
}

}  // namespace
}  // namespace stepwright::cell_runtime
