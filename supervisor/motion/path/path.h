#pragma once

// A path of an arm: configurations, and straight motions of the joints between them. Values; any thread.

#include <cmath>
#include <span>
#include <vector>

namespace stepwright::motion {

using Configuration = std::vector<double>;
using JointPath = std::vector<Configuration>;

// Root of the sum of squares, in rad (and m for joints that slide).
inline double joint_distance(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum);
}

inline double joint_length(const JointPath& path) {
  double sum = 0.0;
  for (std::size_t k = 1; k < path.size(); ++k) sum += joint_distance(path[k - 1], path[k]);
  return sum;
}

}  // namespace stepwright::motion
