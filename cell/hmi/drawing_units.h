#pragma once

// A length in a drawing's own units, as SVG writes it. Pure; any thread.

#include <array>
#include <cstdio>
#include <string>

namespace stepwright::hmi {

inline std::string units(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f", value);
  return text.data();
}

}  // namespace stepwright::hmi
