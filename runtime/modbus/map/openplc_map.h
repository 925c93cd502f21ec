#pragma once

// The map that users of OpenPLC know (OpenPLC v3, webserver/core/modbus.cpp; v4 has the same defaults):
//
//   coils     0..8191      %QX0.0 .. %QX1023.7      discrete  0..8191    %IX0.0 .. %IX1023.7
//   holding   0..1023      %QW0 .. %QW1023          input     0..1023    %IW0 .. %IW1023
//             1024..2047   %MW0 .. %MW1023
//             2048..4095   %MD0 .. %MD1023, two registers each, the most significant first
//             4096..8191   %ML0 .. %ML1023, four registers each, the most significant first
//
// Addresses of what the program does not have read 0 and take no writes. There %MW, %MD and %ML are tables of
// their own; here they are views of the same bytes, as addresses are everywhere in Stepwright: %MD1 is %MW2
// and %MW3. Pure functions; any thread.

#include <array>
#include <vector>

#include "runtime/bytecode/container_format.h"
#include "runtime/modbus/map/segment.h"

namespace stepwright::modbus::map {

// All of it, zeros included, sorted.
std::array<std::vector<Segment>, kTables> openplc_segments(const bytecode::SizesRecord& sizes, bool writable);

}  // namespace stepwright::modbus::map
