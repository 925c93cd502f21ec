#pragma once

// A plant behind the process image: terminals of the plant wired to %I and %Q addresses, in lock-step
// with the scan. read_inputs(now) runs the plant up to `now` and samples the sensors; write_outputs
// latches the actuators, which hold from there on. A terminal that no wire names stays off or unread.
//
// Thread rule: the scan thread. Neither call allocates, locks or throws. The plant must outlive the driver.
//
//   std::vector<PortWire> wires = {{"fc1", "%IX0.0", {file, 12}}, {"B1", "%QX0.0", {file, 13}}};
//   auto driver = PlantDriver::create(plant, wires, {.input_bytes = 8, .output_bytes = 2});

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "plant_models/core/plant.h"
#include "runtime/ground/result/result.h"
#include "runtime/image/io_driver.h"

namespace stepwright::bridge {

// One wire, as a cell file writes it.
struct PortWire {
  std::string port;        // actuator or sensor of the plant
  std::string address;     // "%IX0.0" for a switch, "%IW1" for counts, "%QX0.0" for an actuator
  result::Location where;  // for diagnostics
};

// The wiring of the tank bench when a cell file gives none: inputs %IX0.0 to %IX0.2 and %IW1 to %IW3,
// outputs %QX0.0 to %QX0.5, in the order of paper 6, Tables 1 to 3.
std::vector<PortWire> default_bench_wires();

// The wiring of a fleet of `vehicles` when a cell file gives none. Inputs: x, y, heading, speed and lock of
// v1 in %IW0 to %IW4, of v2 in %IW5 to %IW9 and so on; behind all words a byte for each vehicle with lifted,
// lowered, loaded and bumper; then a byte with estop_ok. Outputs: set_speed and set_lock of each, then a byte
// for each with enable and lift.
std::vector<PortWire> default_fleet_wires(std::size_t vehicles);

// The wiring of a tugger train with terminals for so many trailers, in a hall with those places, when a cell
// file gives none. Inputs: x, y, heading, speed and lock in %IW0 to %IW4, then hitch_1 and so on, then
// trailers; behind all words a byte with bumper, estop_ok and way_free; from the next byte on a bit for each
// place. Outputs: set_speed in %QW0, set_lock in %QW1, enable in %QX4.0.
std::vector<PortWire> default_tugger_wires(std::size_t trailers, std::span<const std::string> places);

// The wiring of a robot cell with those arms and so many slots of its camera, when a cell file gives none.
// Inputs: of each arm pos_ARM_1 to _7 and width_ARM; then camera_pictures, camera_seen and kind, x, y, z, yaw
// of each slot; behind all words a byte for each arm with ready, trip and grasp, and a byte with estop_ok.
// Outputs: of each arm set_ARM_1 to _7 and grip_ARM; then a byte for each arm with enable, and a byte with
// camera_trigger.
std::vector<PortWire> default_robot_cell_wires(std::span<const std::string> arms, std::size_t slots);

// Sizes of the areas that the scan passes to the driver.
struct AreaSizes {
  std::size_t input_bytes = 0;
  std::size_t output_bytes = 0;
};

class PlantDriver final : public image::IoDriver {
 public:
  // Fails with every wrong wire: C0301 (no such port), C0302 (no address), C0303 (outside the area),
  // C0304 (two wires on the same bits), C0305 (port wired twice), C0306 (wrong area or width for the port).
  [[nodiscard]] static result::Result<PlantDriver> create(core::Plant& plant, std::span<const PortWire> wires,
                                                          AreaSizes sizes);

  // Both give IoStatus::Lost when the plant has failed or an area is smaller than create() was told.
  image::IoStatus read_inputs(std::int64_t now_ns, std::span<std::byte> inputs) override;
  image::IoStatus write_outputs(std::int64_t now_ns, std::span<const std::byte> outputs) override;

 private:
  struct SwitchWire {
    core::SensorId sensor;
    std::uint32_t byte;
    std::byte mask;
  };
  struct CountWire {
    core::SensorId sensor;
    std::uint32_t byte;
  };
  struct RelayWire {
    core::ActuatorId actuator;
    std::uint32_t byte;
    std::byte mask;
  };
  struct SetpointWire {
    core::ActuatorId actuator;
    std::uint32_t byte;
  };

  PlantDriver(core::Plant& plant, AreaSizes sizes) : plant_(&plant), sizes_(sizes) {}

  core::Plant* plant_;
  AreaSizes sizes_;
  core::PlantStatus status_ = core::PlantStatus::Good;
  std::vector<SwitchWire> switches_;
  std::vector<CountWire> counts_;
  std::vector<RelayWire> relays_;
  std::vector<SetpointWire> setpoints_;
};

}  // namespace stepwright::bridge
