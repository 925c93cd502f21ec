#pragma once

// Random changes of a container, the same for the same seed: flipped bits, edited fields, exchanged sections,
// overwritten code, records copied over others.

#include <cstddef>
#include <random>
#include <vector>

namespace stepwright::fuzz {

// Requires a well-formed container; changes it in one to four ways and puts the header right.
std::vector<std::byte> mutated(std::vector<std::byte> container, std::mt19937& random);

}  // namespace stepwright::fuzz
