#include "plant_models/bridge/port_map.h"

#include <iterator>
#include <optional>
#include <string>

#include "plant_models/core/names.h"

namespace stepwright::bridge {
namespace {

using result::fail;
using result::Result;

std::optional<CheckedWire> find_port(const core::Plant& plant, std::string_view name) {
  if (const auto actuator = core::find_actuator(plant, name)) {
    return CheckedWire{true, plant.actuators()[actuator->value].kind, actuator->value, {}};
  }
  if (const auto sensor = core::find_sensor(plant, name)) {
    return CheckedWire{false, plant.sensors()[sensor->value].kind, sensor->value, {}};
  }
  return std::nullopt;
}

Result<CheckedWire> check_wire(const core::Plant& plant, const PortWire& wire, AreaSizes sizes) {
  auto checked = find_port(plant, wire.port);
  if (!checked) {
    return fail("C0301", wire.where, "the plant has no port named '" + wire.port + "'",
                "actuators: " + core::joined_names(plant.actuators()) +
                    "; sensors: " + core::joined_names(plant.sensors()));
  }
  auto address = parse_io_address(wire.address, wire.where);
  if (!address) return result::forward(address);
  const IoArea area = checked->is_actuator ? IoArea::Output : IoArea::Input;
  const IoWidth width = checked->kind == core::PortKind::Bool ? IoWidth::Bit : IoWidth::Word;
  if (address->area != area || address->width != width) {
    const std::string wanted =
        std::string(area == IoArea::Input ? "%I" : "%Q") + (width == IoWidth::Bit ? "X" : "W");
    return fail("C0306", wire.where, "port '" + wire.port + "' cannot be wired to " + to_string(*address),
                std::string(checked->is_actuator ? "an actuator" : "a sensor") + " of this kind takes a " +
                    wanted + " address");
  }
  const std::size_t available = area == IoArea::Input ? sizes.input_bytes : sizes.output_bytes;
  if (address->first_bit() + address->size_bits() > available * 8) {
    return fail("C0303", wire.where, to_string(*address) + " lies outside the image",
                "the " + std::string(area == IoArea::Input ? "input" : "output") + " area has " +
                    std::to_string(available) + " bytes");
  }
  checked->address = *address;
  return *checked;
}

bool overlap(const IoAddress& a, const IoAddress& b) {
  return a.area == b.area && a.first_bit() < b.first_bit() + b.size_bits() &&
         b.first_bit() < a.first_bit() + a.size_bits();
}

// What is wrong between a wire and one before it.
Result<void> check_pair(const CheckedWire& before, const std::string& before_port, const CheckedWire& wire,
                        const PortWire& text) {
  if (before.is_actuator == wire.is_actuator && before.port == wire.port) {
    return fail("C0305", text.where, "port '" + text.port + "' is wired twice",
                "it is wired to " + to_string(before.address) + " already");
  }
  if (overlap(before.address, wire.address)) {
    return fail("C0304", text.where,
                to_string(wire.address) + " overlaps " + to_string(before.address) + ", to which '" +
                    before_port + "' is wired",
                "%IW1 is bytes 2 and 3: bits and words share the area");
  }
  return {};
}

}  // namespace

Result<std::vector<CheckedWire>> check_wires(const core::Plant& plant, std::span<const PortWire> wires,
                                             AreaSizes sizes) {
  std::vector<CheckedWire> good;
  std::vector<std::string> names;
  result::Diagnostics wrong;
  const auto note = [&wrong](result::Diagnostics& found) {
    wrong.insert(wrong.end(), std::make_move_iterator(found.begin()), std::make_move_iterator(found.end()));
  };
  for (const PortWire& wire : wires) {
    auto checked = check_wire(plant, wire, sizes);
    if (!checked) {
      note(checked.error());
      continue;
    }
    for (std::size_t i = 0; i < good.size(); ++i) {
      auto pair = check_pair(good[i], names[i], *checked, wire);
      if (!pair) note(pair.error());
    }
    good.push_back(*checked);
    names.push_back(wire.port);
  }
  if (!wrong.empty()) return tl::unexpected<result::Diagnostics>(std::move(wrong));
  return good;
}

}  // namespace stepwright::bridge
