#pragma once

// The program that is scanned where the user brings none: rungs as a ladder has them, in ST.

#include <cstdint>
#include <string>

namespace stepwright::scan_test {

// `rungs` networks of three contacts and a coil over changing values, in one task of this interval.
std::string rung_source(std::uint32_t rungs, std::int64_t interval_us);

}  // namespace stepwright::scan_test
