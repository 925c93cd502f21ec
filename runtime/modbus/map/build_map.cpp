#include "runtime/modbus/map/build_map.h"

#include <algorithm>
#include <string>

#include "runtime/modbus/map/openplc_map.h"
#include "runtime/modbus/map/resolve_range.h"

namespace stepwright::modbus::map {
namespace {

using Segments = RegisterMap::Segments;

bool before(const Segment& left, const Segment& right) {
  return left.first < right.first;
}

// False if one is there already at any of its addresses.
bool insert(Segments& segments, const Segment& segment) {
  const auto next = std::lower_bound(segments.begin(), segments.end(), segment, before);
  if (next != segments.end() && next->first < segment.end()) return false;
  if (next != segments.begin() && std::prev(next)->end() > segment.first) return false;
  segments.insert(next, segment);
  return true;
}

// What lies from `first` to before `end` of a segment, in whole values.
Segment piece(const Segment& whole, std::uint32_t first, std::uint32_t end) {
  const std::uint32_t registers = registers_of(whole.kind);
  const std::uint32_t skipped = (first - whole.first + registers - 1) / registers;  // values
  Segment part = whole;
  part.first = whole.first + skipped * registers;
  part.count = end > part.first ? (end - part.first) / registers * registers : 0;
  if (whole.kind == Kind::Bits) {
    part.address = whole.address + (whole.bit + skipped) / 8;
    part.bit = static_cast<std::uint8_t>((whole.bit + skipped) % 8);
  } else if (whole.kind != Kind::Zero) {
    part.address = whole.address + skipped * bytes_of(whole.kind);
  }
  return part;
}

// Adds what the segments there leave of it.
void fill(Segments& segments, const Segment& whole) {
  Segments pieces;
  std::uint32_t at = whole.first;
  for (const Segment& taken : segments) {
    if (taken.end() <= at || taken.first >= whole.end()) continue;
    if (taken.first > at) pieces.push_back(piece(whole, at, taken.first));
    at = taken.end();
  }
  if (at < whole.end()) pieces.push_back(piece(whole, at, whole.end()));
  for (const Segment& part : pieces)
    if (part.count > 0) insert(segments, part);
}

}  // namespace

BuiltMap build_map(const reader::ProgramInfo& info, const MapConfig& config) {
  BuiltMap built;
  std::array<Segments, kTables> tables;
  for (const RangeConfig& range : config.ranges) {
    auto segment = resolve_range(range, info);
    if (!segment) {
      built.problems.insert(built.problems.end(), segment.error().begin(), segment.error().end());
      continue;
    }
    if (insert(tables[static_cast<std::size_t>(range.table)], *segment)) continue;
    auto failed = result::fail("C0503", range.at_first.file.empty() ? range.where : range.at_first,
                               "the " + std::string(name_of(range.table)) + " addresses " +
                                   std::to_string(segment->first) + " to " +
                                   std::to_string(segment->end() - 1) + " belong in part to another range",
                               "every address stands for one value");
    built.problems.push_back(std::move(failed.value().front()));
  }
  if (config.openplc) {
    const auto defaults = openplc_segments(info.sizes(), config.openplc_writable);
    for (std::size_t table = 0; table < kTables; ++table)
      for (const Segment& segment : defaults[table]) fill(tables[table], segment);
  }
  built.map = RegisterMap(std::move(tables));
  return built;
}

}  // namespace stepwright::modbus::map
