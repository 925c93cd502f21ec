#pragma once

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/result/result.h"
#include "runtime/modbus/map/map_config.h"
#include "runtime/modbus/map/segment.h"

namespace stepwright::modbus::map {

// The addresses and the variables of a range in a program. Diagnostics at the range's place: C0501 a name
// that the program does not have; C0502 more values than there are, or addresses beyond 65535; C0504
// writable, but a table, a constant or inputs that clients must not write; C0505 a type that has no place in
// that table (strings). Pure; any thread.
[[nodiscard]] result::Result<Segment> resolve_range(const RangeConfig& range,
                                                    const reader::ProgramInfo& info);

}  // namespace stepwright::modbus::map
