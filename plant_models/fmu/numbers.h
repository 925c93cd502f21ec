#pragma once

// Numbers as an FMU takes them.
//
// Thread-safe: pure.

#include <cmath>
#include <limits>
#include <type_traits>

namespace stepwright::fmu {

// The nearest number of that type: beyond its range its end; NaN is 0 in whole numbers. A Boolean is true
// unless 0.
template <typename T>
T nearest(double number) {
  if constexpr (std::is_same_v<T, bool>) {
    return number != 0.0;
  } else if constexpr (std::is_integral_v<T>) {
    if (std::isnan(number)) return T{};
    if (number <= static_cast<double>(std::numeric_limits<T>::min())) return std::numeric_limits<T>::min();
    if (number >= static_cast<double>(std::numeric_limits<T>::max())) return std::numeric_limits<T>::max();
    return static_cast<T>(number);
  } else {
    return static_cast<T>(number);
  }
}

}  // namespace stepwright::fmu
