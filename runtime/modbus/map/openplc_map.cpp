#include "runtime/modbus/map/openplc_map.h"

#include <algorithm>

namespace stepwright::modbus::map {
namespace {

using Segments = std::vector<Segment>;

constexpr std::uint32_t kBits = 8'192;    // of %QX and %IX
constexpr std::uint32_t kValues = 1'024;  // of each other table
constexpr std::uint32_t kMarkerWords = 1'024;
constexpr std::uint32_t kMarkerDwords = 2'048;
constexpr std::uint32_t kMarkerLwords = 4'096;

// `count` values from `first` on, of which the program has those of `bytes` bytes at `address`.
void add(Segments& segments, std::uint32_t first, std::uint32_t count, Kind kind, std::uint32_t address,
         std::uint32_t bytes, bool writable) {
  const std::uint32_t there = std::min(count, kind == Kind::Bits ? bytes * 8 : bytes / bytes_of(kind));
  const std::uint32_t registers = registers_of(kind);
  Segment segment;
  segment.first = first;
  segment.count = there * registers;
  segment.address = address;
  segment.kind = kind;
  segment.writable = writable;
  if (segment.count > 0) segments.push_back(segment);
  Segment zeros;
  zeros.first = first + segment.count;
  zeros.count = count * registers - segment.count;
  if (zeros.count > 0) segments.push_back(zeros);
}

}  // namespace

std::array<Segments, kTables> openplc_segments(const bytecode::SizesRecord& sizes, bool writable) {
  std::array<Segments, kTables> tables;
  const std::uint32_t outputs = sizes.input_bytes;
  const std::uint32_t markers = outputs + sizes.output_bytes;
  add(tables[0], 0, kBits, Kind::Bits, outputs, sizes.output_bytes, writable);
  add(tables[1], 0, kBits, Kind::Bits, 0, sizes.input_bytes, false);
  Segments& holding = tables[static_cast<std::size_t>(Table::HoldingRegisters)];
  add(holding, 0, kValues, Kind::Word, outputs, sizes.output_bytes, writable);
  add(holding, kMarkerWords, kValues, Kind::Word, markers, sizes.marker_bytes, writable);
  add(holding, kMarkerDwords, kValues, Kind::Dword, markers, sizes.marker_bytes, writable);
  add(holding, kMarkerLwords, kValues, Kind::Lword, markers, sizes.marker_bytes, writable);
  add(tables[static_cast<std::size_t>(Table::InputRegisters)], 0, kValues, Kind::Word, 0, sizes.input_bytes,
      false);
  return tables;
}

}  // namespace stepwright::modbus::map
