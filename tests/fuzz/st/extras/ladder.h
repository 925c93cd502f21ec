#pragma once

// A random ladder diagram: the function block Zladder, whose rungs have contacts, edges and comparisons in
// series and in parallel, coils of every kind, a timer, statements under EN, jumps and an early return.

#include <cstdint>

#include "ladder/graphic/project.h"

namespace stepwright::st_fuzz {

// The same for the same seed. Inputs zg0..zg2 : BOOL, zn : INT; outputs zq0, zq1 : BOOL, zm : INT.
graphic::Project random_ladder(std::uint64_t seed);

}  // namespace stepwright::st_fuzz
