#pragma once

// Random changes of a stream: bits, numbers that counts and lengths are made of, pieces left out, repeated or
// taken from another seed.

#include <random>
#include <vector>

#include "tests/fuzz/modbus/seeds.h"

namespace stepwright::fuzz::modbus {

// At most 1200 bytes, never empty.
Bytes mutated(Bytes bytes, const std::vector<Seed>& seeds, std::mt19937& random);

}  // namespace stepwright::fuzz::modbus
