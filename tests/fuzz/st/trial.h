#pragma once

// One program from its seed, run and compared; where something differs, the smallest program that still does.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/fuzz/st/st_writer.h"

namespace stepwright::st_fuzz {

inline constexpr std::uint64_t kScans = 8;

struct Outcome {
  std::string difference;   // empty: none
  std::uint64_t scans = 0;  // that ran, the one that trapped included
  std::uint8_t trap = 0;    // of the last one
};

// All engines of this machine.
Outcome try_engines(const Program& program, const Dropped& dropped);

// The interpreter and C. In one piece, as starting the C compiler is what costs.
std::vector<Outcome> try_c(const std::vector<const Program*>& programs, const Dropped& dropped);

// Leaves out statements as long as it still differs: what to show, ST with the difference as a comment.
std::string reduced(const Program& program, Outcome (*attempt)(const Program&, const Dropped&));
Outcome try_c_alone(const Program& program, const Dropped& dropped);

}  // namespace stepwright::st_fuzz
