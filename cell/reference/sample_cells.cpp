#include "cell/reference/sample_cells.h"

#include <array>

namespace stepwright::reference {
namespace {

constexpr std::string_view kWhole = R"(
[tasks.NAME]
cpu = 0
[runtime]
cpu = 0
[plant.ports]
PORT = "%IX0.0"
[safe_state.outputs]
"%QW0" = { value = 1 }
[tags.TAG]
decimals = 1
range = [0, 1]
[[notify]]
[[monitors]]
let = { NAME = "TRUE" }
on_false = ["alarm"]
[[faults]]
[controller]
metrics = { port = 1 }
[dds]
interfaces = ["127.0.0.1"]
)";

constexpr std::string_view kShort = R"(
[safe_state.outputs]
"%QW0" = "hold"
)";

constexpr std::string_view kMissions = R"(
[planning]
[[fleet.orders]]
[[fleet.requests]]
[[ltl.requests]]
[[tamp.orders]]
[[tamp.requests]]
)";

constexpr std::string_view kFleet = R"(
[plant]
kind = "fleet"
[[plant.vehicles]]
[[plant.pallets]]
[[plant.blockages]]
)";

constexpr std::string_view kTugger = R"(
[plant]
kind = "tugger"
[plant.start]
x_m = 0.0
[[plant.blockages]]
)";

constexpr std::string_view kRobotCell = R"(
[plant]
kind = "robot_cell"
[[plant.arms]]
start_rad = []
[[plant.fixed]]
[[plant.objects]]
length_m = 1.0
width_m = 1.0
height_m = 1.0
mass_kg = 1.0
[[plant.blockages]]
[plant.drive]
acceleration_rad_s2 = []
inertia_kgm2 = []
)";

constexpr std::string_view kModel = R"(
[plant]
kind = "model"
)";

constexpr std::string_view kSteppedTables = R"(
[plant]
kind = "shared"
[plant.sensors.NAME]
range = [0, 1]
[plant.actuators.NAME]
range = [0, 1]
[plant.values]
NAME = "m"
[plant.faults.NAME]
range = [0, 1]
)";

constexpr std::string_view kStepped = R"(
[plant]
kind = "st"
[plant.sensors]
NAME = "%IW0"
[plant.actuators]
NAME = "%QW0"
[plant.faults]
NAME = "m"
[plant.parameters]
NAME = 1.0
)";

constexpr std::string_view kModbus = R"(
[clock]
mode = "real"
[io]
kind = "modbus"
[modbus.client]
metrics = { port = 1 }
[modbus.lines.LINE]
gap_us = 1
[[modbus.device]]
name = "a"
host = "h"
[[modbus.device.group]]
[[modbus.device.group.tags]]
address = "%IW0"
holding = 0
iec = "INT"
low = 0.0
high = 1.0
loss_value = 0
age = "%IW2"
[[modbus.device.group.tags]]
address = "%IX8.0"
coil = 0
bit = 0
[[modbus.device.group.tags]]
address = "%IX8.1"
discrete = 0
[[modbus.device.group.tags]]
address = "%IW10"
input = 0
[modbus.server]
metrics = { port = 1 }
[modbus.server.tls]
port = 802
[[modbus.server.line]]
[[modbus.server.range]]
variable = "V"
[[modbus.server.client]]
)";

constexpr std::array kCells = {kWhole,     kShort, kMissions,      kFleet,   kTugger,
                               kRobotCell, kModel, kSteppedTables, kStepped, kModbus};

}  // namespace

std::span<const std::string_view> sample_cells() {
  return kCells;
}

}  // namespace stepwright::reference
