#pragma once

// Greatest length of a text with a formula: whoever reads one from a file reads no more.

#include <cstddef>

namespace stepwright::ltl {

inline constexpr std::size_t kMostFormulaBytes = 4u << 20;  // 20,000 operators between long names

}  // namespace stepwright::ltl
