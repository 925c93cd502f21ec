#pragma once

// The geometric instances of an action when space is discretised: positions on a region's squares, angles by
// steps of a turn; and a configuration, which is one of them with the pose of the tool. As in the experiments
// of F. Lagriffoul, L. Karlsson, A. Saffiotti 2012: squares of 5 cm on trays and 15 cm on tables, 16 angles.
//
// Pure functions; any thread.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "supervisor/tamp/intervals/sequence/work_cell.h"

namespace stepwright::tamp {

struct Discretisation {
  std::vector<double> square_m;  // of each region; beyond the end: 0.05
  std::uint32_t angles = 16;     // of a turn; a power of two

  double square(std::size_t region) const { return region < square_m.size() ? square_m[region] : 0.05; }
};

// What an object is after an action, and how the hand is then.
struct Configuration {
  std::size_t action = 0;
  std::size_t arm = 0;
  std::size_t object = 0;
  Point3 at{};      // of the object
  Angle angle = 0;  // of the object
  Point3 tool{};
  Angle tool_angle = 0;
  friend bool operator==(const Configuration&, const Configuration&) = default;
};

// The middles of the squares, row by row; one at least.
std::vector<Point3> squares_of(const Region& region, double square_m);
// 0, 1, ... steps of a turn.
std::vector<Angle> angles_of(const Discretisation& how);

}  // namespace stepwright::tamp
