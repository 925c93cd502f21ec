#pragma once

// Longest time that a test waits for the product's word before it fails. No measure of a machine: one that is
// busy with something else may be a hundred times slower.

#include <chrono>

namespace stepwright::support {

inline constexpr std::chrono::seconds kPatience{300};

}  // namespace stepwright::support
