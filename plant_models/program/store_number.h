#pragma once

// Writes a number into a variable of a program, as read_number (runtime/bytecode/reader) reads it: BOOLs are
// true where it is not 0, TIME is in nanoseconds, integers are rounded and stay within their range.
//
// Threads: any. A variable outside of the image and a string stay as they are.

#include <cstddef>
#include <span>

#include "runtime/bytecode/reader/program_info.h"

namespace stepwright::program_plant {

void store_number(const reader::Variable& variable, double number, std::span<std::byte> image);

}  // namespace stepwright::program_plant
