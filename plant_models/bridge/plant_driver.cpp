#include "plant_models/bridge/plant_driver.h"

#include <array>
#include <chrono>
#include <string>
#include <utility>

#include "plant_models/bridge/port_map.h"

namespace stepwright::bridge {

std::vector<PortWire> default_bench_wires() {
  return {{"fc1", "%IX0.0", {}},
          {"fc2", "%IX0.1", {}},
          {"fc3", "%IX0.2", {}},
          {"S1", "%IW1", {}},
          {"S2", "%IW2", {}},
          {"S3", "%IW3", {}},
          {"B1", "%QX0.0", {}},
          {"B2", "%QX0.1", {}},
          {"drive_left", "%QX0.2", {}},
          {"B3", "%QX0.4", {}},
          {"drive_right", "%QX0.3", {}},
          {"B4", "%QX0.5", {}}};
}

std::vector<PortWire> default_fleet_wires(std::size_t vehicles) {
  constexpr std::array<const char*, 5> kInputWords = {"x", "y", "heading", "speed", "lock"};
  constexpr std::array<const char*, 4> kSwitches = {"lifted", "lowered", "loaded", "bumper"};
  constexpr std::array<const char*, 2> kOutputWords = {"set_speed", "set_lock"};
  constexpr std::array<const char*, 2> kRelays = {"enable", "lift"};
  std::vector<PortWire> wires;
  const auto add = [&](std::size_t v, const auto& words, const auto& bits, const std::string& area) {
    const std::string vehicle = "_v" + std::to_string(v + 1);
    const std::size_t byte = 2 * words.size() * vehicles + v;
    for (std::size_t k = 0; k < words.size(); ++k) {
      wires.push_back({words[k] + vehicle, "%" + area + "W" + std::to_string(words.size() * v + k), {}});
    }
    for (std::size_t k = 0; k < bits.size(); ++k) {
      wires.push_back(
          {bits[k] + vehicle, "%" + area + "X" + std::to_string(byte) + "." + std::to_string(k), {}});
    }
  };
  for (std::size_t v = 0; v < vehicles; ++v) {
    add(v, kInputWords, kSwitches, "I");
    add(v, kOutputWords, kRelays, "Q");
  }
  wires.push_back({"estop_ok", "%IX" + std::to_string((2 * kInputWords.size() + 1) * vehicles) + ".0", {}});
  return wires;
}

std::vector<PortWire> default_tugger_wires(std::size_t trailers, std::span<const std::string> places) {
  std::vector<std::string> words = {"x", "y", "heading", "speed", "lock"};
  for (std::size_t k = 1; k <= trailers; ++k) words.push_back("hitch_" + std::to_string(k));
  words.emplace_back("trailers");
  std::vector<PortWire> wires;
  for (std::size_t k = 0; k < words.size(); ++k) wires.push_back({words[k], "%IW" + std::to_string(k), {}});
  const auto add_switch = [&](const std::string& name, std::size_t byte, std::size_t bit) {
    wires.push_back({name, "%IX" + std::to_string(byte + bit / 8) + "." + std::to_string(bit % 8), {}});
  };
  const std::size_t switches = 2 * words.size();
  add_switch("bumper", switches, 0);
  add_switch("estop_ok", switches, 1);
  add_switch("way_free", switches, 2);
  for (std::size_t k = 0; k < places.size(); ++k) add_switch("at_" + places[k], switches + 1, k);
  wires.push_back({"set_speed", "%QW0", {}});
  wires.push_back({"set_lock", "%QW1", {}});
  wires.push_back({"enable", "%QX4.0", {}});
  return wires;
}

std::vector<PortWire> default_robot_cell_wires(std::span<const std::string> arms, std::size_t slots) {
  std::vector<std::string> inputs;
  std::vector<std::string> outputs;
  for (const std::string& arm : arms) {
    for (int joint = 1; joint <= 7; ++joint) {
      inputs.push_back("pos_" + arm + "_" + std::to_string(joint));
      outputs.push_back("set_" + arm + "_" + std::to_string(joint));
    }
    inputs.push_back("width_" + arm);
    outputs.push_back("grip_" + arm);
  }
  inputs.insert(inputs.end(), {"camera_pictures", "camera_seen"});
  for (std::size_t k = 1; k <= slots; ++k)
    for (const char* what : {"_kind", "_x", "_y", "_z", "_yaw"})
      inputs.push_back("seen_" + std::to_string(k) + what);
  std::vector<PortWire> wires;
  for (std::size_t k = 0; k < inputs.size(); ++k) wires.push_back({inputs[k], "%IW" + std::to_string(k), {}});
  for (std::size_t k = 0; k < outputs.size(); ++k)
    wires.push_back({outputs[k], "%QW" + std::to_string(k), {}});
  const auto bit = [&](const std::string& name, const char* area, std::size_t byte, int place) {
    wires.push_back({name, area + std::to_string(byte) + "." + std::to_string(place), {}});
  };
  const std::size_t in = 2 * inputs.size();
  const std::size_t out = 2 * outputs.size();
  for (std::size_t k = 0; k < arms.size(); ++k) {
    bit("ready_" + arms[k], "%IX", in + k, 0);
    bit("trip_" + arms[k], "%IX", in + k, 1);
    bit("grasp_" + arms[k], "%IX", in + k, 2);
    bit("enable_" + arms[k], "%QX", out + k, 0);
  }
  bit("estop_ok", "%IX", in + arms.size(), 0);
  bit("camera_trigger", "%QX", out + arms.size(), 0);
  return wires;
}

result::Result<PlantDriver> PlantDriver::create(core::Plant& plant, std::span<const PortWire> wires,
                                                AreaSizes sizes) {
  auto checked = check_wires(plant, wires, sizes);
  if (!checked) return result::forward(checked);
  PlantDriver driver(plant, sizes);
  for (const CheckedWire& wire : *checked) {
    const std::uint32_t byte = wire.address.byte;
    const auto mask = std::byte{1} << wire.address.bit;
    const bool is_bit = wire.kind == core::PortKind::Bool;
    if (wire.is_actuator && is_bit) {
      driver.relays_.push_back({core::ActuatorId(wire.port), byte, mask});
    } else if (wire.is_actuator) {
      driver.setpoints_.push_back({core::ActuatorId(wire.port), byte});
    } else if (is_bit) {
      driver.switches_.push_back({core::SensorId(wire.port), byte, mask});
    } else {
      driver.counts_.push_back({core::SensorId(wire.port), byte});
    }
  }
  return driver;
}

image::IoStatus PlantDriver::read_inputs(std::int64_t now_ns, std::span<std::byte> inputs) {
  if (inputs.size() < sizes_.input_bytes) return image::IoStatus::Lost;
  status_ = plant_->advance_to(std::chrono::nanoseconds(now_ns));
  for (const SwitchWire& wire : switches_) {
    const bool closed = plant_->sensor(wire.sensor) != 0;
    inputs[wire.byte] = closed ? inputs[wire.byte] | wire.mask : inputs[wire.byte] & ~wire.mask;
  }
  for (const CountWire& wire : counts_) {
    const auto counts = static_cast<std::uint16_t>(plant_->sensor(wire.sensor));
    inputs[wire.byte] = static_cast<std::byte>(counts & 0xFF);
    inputs[wire.byte + 1] = static_cast<std::byte>(counts >> 8);
  }
  return status_ == core::PlantStatus::Good ? image::IoStatus::Good : image::IoStatus::Lost;
}

image::IoStatus PlantDriver::write_outputs(std::int64_t now_ns, std::span<const std::byte> outputs) {
  if (outputs.size() < sizes_.output_bytes) return image::IoStatus::Lost;
  // In simulated time the plant stands there already; in real time a scan takes a moment.
  status_ = plant_->advance_to(std::chrono::nanoseconds(now_ns));
  for (const RelayWire& wire : relays_) {
    const bool on = (outputs[wire.byte] & wire.mask) != std::byte{0};
    plant_->set_actuator(wire.actuator, on ? 1 : 0);
  }
  for (const SetpointWire& wire : setpoints_) {
    const unsigned counts = std::to_integer<unsigned>(outputs[wire.byte]) |
                            std::to_integer<unsigned>(outputs[wire.byte + 1]) << 8;
    plant_->set_actuator(wire.actuator, static_cast<std::int16_t>(static_cast<std::uint16_t>(counts)));
  }
  return status_ == core::PlantStatus::Good ? image::IoStatus::Good : image::IoStatus::Lost;
}

}  // namespace stepwright::bridge
