#pragma once

// Random changes of problems and maps, the same for the same random numbers: values left out, doubled,
// exchanged and taken from other texts, numbers that bounds are made of, wrong bytes, ends in the middle.

#include <random>
#include <string>
#include <vector>

namespace stepwright::fuzz::fleet {

// One to four changes. `all`: the texts to take values from; not empty.
std::string mutated(std::string text, const std::vector<std::string>& all, std::mt19937& random);

}  // namespace stepwright::fuzz::fleet
