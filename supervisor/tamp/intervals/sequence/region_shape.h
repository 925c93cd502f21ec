#pragma once

// A region as what constraints are made of: a box of x and y around it and, where it is turned, the four
// sides as linear conditions on nanometres. Rounded outward. A pure function; any thread.

#include <array>
#include <vector>

#include "supervisor/tamp/intervals/sequence/work_cell.h"

namespace stepwright::tamp {

// x_factor * x + y_factor * y <= high_nm.
struct HalfPlane {
  double x_factor = 0.0, y_factor = 0.0, high_nm = 0.0;
};

struct RegionShape {
  Span x, y;
  std::vector<HalfPlane> sides;  // empty where x and y say it all
};

RegionShape shape_of(const Region& region);

}  // namespace stepwright::tamp
