#pragma once

// Test for bytes of a block that are values of their types. A program never makes others, so that engines
// need not look again; a file may hold any.
//
// Threads: any; O(bytes).

#include <cstddef>
#include <span>
#include <string>

#include "runtime/record/state_layout.h"

namespace stepwright::record {

// The first that is none: a number outside of its subrange, a BOOL that is neither 0 nor 1, a string longer
// than its capacity or of another one. "MAIN.speed: 30 is outside of 0..10"; empty if there is none. Requires
// as many bytes as the layout says.
std::string wrong_value(const StateLayout& layout, std::span<const std::byte> block);

}  // namespace stepwright::record
