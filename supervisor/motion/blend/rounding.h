#pragma once

// Rounding of a corner: a ramp that is 0 up to -1, x from 1 on and a quartic between, with a continuous
// second derivative (doc: supervisor/doc/motion_timing.md). Values; any thread.
//
//   q(s) = corner + before * (s - s0) + (after - before) * rounding(s - s0, half_width).value

namespace stepwright::motion {

struct Rounding {
  double value = 0.0, first = 0.0, second = 0.0, third = 0.0;  // derivatives by `along`

  static constexpr double kDeviation = 3.0 / 16.0;  // value at the corner over half_width: the greatest
};

// Requires -half_width <= along <= half_width, up to rounding errors, and half_width > 0.
constexpr Rounding rounding(double along, double half_width) {
  const double x = along / half_width;
  return {half_width * (3.0 + x * (8.0 + x * (6.0 - x * x))) / 16.0, (2.0 + x * (3.0 - x * x)) / 4.0,
          0.75 * (1.0 - x * x) / half_width, -1.5 * x / (half_width * half_width)};
}

}  // namespace stepwright::motion
