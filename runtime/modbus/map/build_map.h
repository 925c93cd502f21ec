#pragma once

// The map of a program, as a configuration wants it.
//
//   const BuiltMap built = build_map(info, config);
//   built.problems;      // what does not fit this program; the rest is served
//
// Pure; any thread.

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/result/diagnostic.h"
#include "runtime/modbus/map/map_config.h"
#include "runtime/modbus/map/register_map.h"

namespace stepwright::modbus::map {

struct BuiltMap {
  RegisterMap map;
  // See resolve_range.h, and C0503: two ranges share addresses; the later one is left out. A range with a
  // problem is not in the map: its addresses stand for nothing (exception 2).
  result::Diagnostics problems;
};

// Ranges win over the default map.
BuiltMap build_map(const reader::ProgramInfo& info, const MapConfig& config);

}  // namespace stepwright::modbus::map
