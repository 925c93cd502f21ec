#include "cell/missions/tamp/arms_wires.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "cell/config/port_reader.h"

namespace stepwright::missions {
namespace {

using tamp::program::CellTerminals;

result::Result<CellTerminals> as_named(const config::CellConfig& config, const tamp::scene::RobotCell& cell) {
  config::PortReader ports(config);
  CellTerminals all;
  for (const auto& arm : cell.arms) {
    tamp::program::ArmTerminals one;
    for (std::size_t k = 0; k < one.pos.size(); ++k) {
      const std::string joint = arm.name + "_" + std::to_string(k + 1);
      one.pos[k] = ports.address("pos_" + joint);
      one.set[k] = ports.address("set_" + joint);
    }
    const std::pair<const char*, std::string*> named[] = {{"width_", &one.width}, {"ready_", &one.ready},
                                                          {"trip_", &one.trip},   {"grasp_", &one.grasp},
                                                          {"grip_", &one.grip},   {"enable_", &one.enable}};
    for (const auto& [name, address] : named) *address = ports.address(name + arm.name);
    all.arms.push_back(std::move(one));
  }
  all.estop_ok = ports.address("estop_ok");
  all.camera_trigger = ports.address("camera_trigger");
  all.camera_pictures = ports.address("camera_pictures");
  all.camera_seen = ports.address("camera_seen");
  const auto has = [&](const std::string& port) {
    return std::ranges::find(config.plant.ports, port, &config::PortAddress::port) !=
           config.plant.ports.end();
  };
  for (std::size_t k = 1; k == 1 || has("seen_" + std::to_string(k) + "_kind"); ++k) {
    const std::string slot = "seen_" + std::to_string(k);
    all.slots.push_back({ports.address(slot + "_kind"), ports.address(slot + "_x"),
                         ports.address(slot + "_y"), ports.address(slot + "_z"),
                         ports.address(slot + "_yaw")});
  }
  if (auto wrong = ports.take(); !wrong.empty()) return tl::unexpected(std::move(wrong));
  return all;
}

}  // namespace

result::Result<CellTerminals> terminals_of(const config::CellConfig& config,
                                           const tamp::scene::RobotCell& cell) {
  if (!config.plant.ports.empty()) return as_named(config, cell);
  std::size_t slots = cell.things.size() + 2;
  if (config.plant.kind == "robot_cell") {
    const config::RobotCellPlantConfig& plant = config.plant.robot_cell;
    slots = plant.camera.slots > 0 ? plant.camera.slots : plant.objects.size() + plant.blockages.size() + 2;
  }
  return tamp::program::cell_terminals_in_a_row(cell.arms.size(), slots);
}

}  // namespace stepwright::missions
