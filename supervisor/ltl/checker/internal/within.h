#pragma once

#include <span>

#include "supervisor/geometry/point.h"

namespace stepwright::ltl::internal {

// Whether a point lies in a polygon: how often a ray to the right of it crosses the outline.
bool within(std::span<const geometry::Point> ring, geometry::Point at);

}  // namespace stepwright::ltl::internal
