#pragma once

// Cube roots by steps of Newton, of sums and products only, so that they are the same on every machine.

namespace stepwright::motion::internal {

// Requires value >= 0 and finite.
inline double cube_root(double value) {
  if (!(value > 0.0)) return 0.0;
  double scale = 1.0;
  while (value >= 8.0) {
    value *= 0.125;
    scale *= 2.0;
  }
  while (value < 1.0) {
    value *= 8.0;
    scale *= 0.5;
  }
  double root = 1.5;
  for (int k = 0; k < 7; ++k) root -= (root * root * root - value) / (3.0 * root * root);
  return scale * root;
}

}  // namespace stepwright::motion::internal
