#pragma once

// Verdict on a word by its first letters. Plain data.

#include <cstdint>

namespace stepwright::ltl {

// The propositions that hold: bit k is the proposition of number k.
using Letter = std::uint64_t;

enum class Verdict : std::uint8_t { Undecided, True, False };

}  // namespace stepwright::ltl
