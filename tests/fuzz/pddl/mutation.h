#pragma once

// Random changes of PDDL text, the same for the same random numbers: words and lists left out, doubled,
// exchanged and taken from other texts, numbers that bounds are made of, wrong bytes, ends in the middle.

#include <random>
#include <string>
#include <vector>

namespace stepwright::fuzz::pddl {

// One to four changes. `all`: the texts to take words from; not empty.
std::string mutated(std::string text, const std::vector<std::string>& all, std::mt19937& random);

}  // namespace stepwright::fuzz::pddl
