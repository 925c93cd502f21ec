#pragma once

// On a serial line an answer that comes after its time meets the next request. What follows it there belongs
// to nobody, and is read and thrown away. Threads: one.

#include <chrono>

namespace stepwright::modbus::master {

// Reads until a frame has gone by, or nothing has come for `patience`; twice that long at most where the
// other side never pauses.
void throw_away_a_frame(int descriptor, std::chrono::milliseconds patience);

}  // namespace stepwright::modbus::master
