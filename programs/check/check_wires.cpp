#include "programs/check/check_wires.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "plant_models/bridge/io_address.h"
#include "programs/runtime/cell_io.h"

namespace stepwright::check {
namespace {

// Bits of an area of the image, the end not included.
using Extent = std::pair<std::uint64_t, std::uint64_t>;

struct Wired {
  std::vector<Extent> inputs;
  std::vector<Extent> outputs;
};

Wired wired_extents(const config::CellConfig& config) {
  Wired wired;
  for (const bridge::PortWire& wire : cell_runtime::plant_wires(config)) {
    const auto address = bridge::parse_io_address(wire.address, wire.where);
    if (!address) continue;  // an error of its own
    auto& extents = address->area == bridge::IoArea::Input ? wired.inputs : wired.outputs;
    extents.emplace_back(address->first_bit(), address->first_bit() + address->size_bits());
  }
  return wired;
}

bool covered(const std::vector<Extent>& extents, const Extent& place) {
  return std::ranges::any_of(
      extents, [&](const Extent& wire) { return wire.first < place.second && place.first < wire.second; });
}

// Within its area, whose first byte is `area`.
Extent extent_of(const reader::Variable& variable, std::uint32_t area) {
  const std::uint64_t first = std::uint64_t{variable.address - area} * 8;
  if (variable.bit != bytecode::kNoBit) return {first + variable.bit, first + variable.bit + 1};
  return {first, first + 8 * std::uint64_t{bytecode::size_of(bytecode::mem_type(variable.type))}};
}

std::string address_text(const reader::Variable& variable, std::uint32_t area, bool output) {
  const std::string prefix = output ? "%Q" : "%I";
  const std::uint32_t byte = variable.address - area;
  if (variable.bit != bytecode::kNoBit)
    return prefix + "X" + std::to_string(byte) + "." + std::to_string(variable.bit);
  const std::uint32_t bytes = bytecode::size_of(bytecode::mem_type(variable.type));
  const char* width = bytes == 1 ? "B" : bytes == 2 ? "W" : bytes == 4 ? "D" : "L";
  return prefix + width + std::to_string(byte / bytes);
}

}  // namespace

result::Diagnostics check_wires(const config::CellConfig& config, const reader::ProgramInfo& info) {
  const bool own_plant =
      config.plant.kind != "none" && !config.safety.io.shared_memory && !config.controller.remote();
  if (!own_plant) return {};
  const Wired wired = wired_extents(config);
  const bytecode::SizesRecord& sizes = info.sizes();
  const result::Location where = config.plant.ports.empty() ? result::Location{config.file.string(), 0, 0}
                                                            : config.plant.ports.front().where;
  result::Diagnostics problems;
  std::set<std::pair<bool, Extent>> told;
  for (const reader::Tag& tag : info.tags()) {
    const std::uint32_t byte = tag.variable.address;
    const bool output = byte >= sizes.input_bytes;
    if (byte >= sizes.input_bytes + sizes.output_bytes || bytecode::is_string(tag.variable.type)) continue;
    const std::uint32_t area = output ? sizes.input_bytes : 0;
    const Extent place = extent_of(tag.variable, area);
    if (covered(output ? wired.outputs : wired.inputs, place) || !told.emplace(output, place).second)
      continue;
    problems.push_back({"C0531", result::Severity::Warning, where,
                        "no port of the plant is wired to " + address_text(tag.variable, area, output) +
                            ", where the program has '" + tag.name + "'",
                        output ? "what the program writes there moves nothing" : "the input never changes"});
  }
  return problems;
}

}  // namespace stepwright::check
