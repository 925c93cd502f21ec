#pragma once

// Pairs of boxes that overlap, among many, by a uniform grid: near-linear in boxes and pairs where boxes are
// of like size.
//
// A pure function; any thread. Boxes that only touch do not overlap.
//
//   for (const auto& [i, k] : overlapping_boxes(boxes, groups)) ...   // i < k, of different groups

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "supervisor/geometry/convex_polygon.h"

namespace stepwright::geometry {

// Each pair once, in ascending order. Boxes of one group are not compared: `groups` names the group of each.
// All coordinates are finite.
std::vector<std::pair<std::uint32_t, std::uint32_t>> overlapping_boxes(std::span<const Box> boxes,
                                                                       std::span<const std::uint32_t> groups);

}  // namespace stepwright::geometry
