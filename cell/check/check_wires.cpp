#include "cell/check/check_wires.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "cell/check/extent.h"
#include "cell/runtime/cell_io.h"
#include "cell/runtime/model_plant.h"
#include "plant_models/bridge/io_address.h"

namespace stepwright::check {
namespace {

std::vector<Extent> wired_extents(const config::CellConfig& config, std::uint32_t input_bytes) {
  std::vector<Extent> wired;
  for (const bridge::PortWire& wire : cell_runtime::plant_wires(config)) {
    const auto address = bridge::parse_io_address(wire.address, wire.where);
    if (!address) continue;  // an error of its own
    const bool output = address->area == bridge::IoArea::Output;
    const std::uint64_t outputs = std::uint64_t{input_bytes} * 8;  // they follow the inputs
    const std::uint64_t first = (output ? outputs : 0) + address->first_bit();
    // An input that the program has not got must not be taken for an output.
    if (output || first < outputs) wired.push_back({first, first + address->size_bits()});
  }
  return wired;
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
  // Whoever reads the plant's file says what is wrong with it.
  const bool by_file = config.plant.kind == "model" && config.plant.ports.empty();
  if (by_file && !cell_runtime::knows_model_wires(config.plant)) return {};
  const bytecode::SizesRecord& sizes = info.sizes();
  const std::vector<Extent> wired = wired_extents(config, sizes.input_bytes);
  const result::Location where = config.plant.ports.empty() ? result::Location{config.file.string(), 0, 0}
                                                            : config.plant.ports.front().where;
  result::Diagnostics problems;
  std::set<Extent> told;
  for (const reader::Tag& tag : info.tags()) {
    const std::uint32_t byte = tag.variable.address;
    const bool output = byte >= sizes.input_bytes;
    if (byte >= sizes.input_bytes + sizes.output_bytes || bytecode::is_string(tag.variable.type)) continue;
    const std::uint32_t area = output ? sizes.input_bytes : 0;
    const Extent place = extent_of(tag.variable);
    const bool covered = std::ranges::any_of(wired, [&](const Extent& wire) { return overlap(wire, place); });
    if (covered || !told.insert(place).second) continue;
    problems.push_back({"C0531", result::Severity::Warning, where,
                        "no port of the plant is wired to " + address_text(tag.variable, area, output) +
                            ", where the program has '" + tag.name + "'",
                        output ? "what the program writes there moves nothing" : "the input never changes"});
  }
  return problems;
}

}  // namespace stepwright::check
