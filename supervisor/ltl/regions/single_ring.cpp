#include "supervisor/ltl/regions/single_ring.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "supervisor/geometry/box.h"
#include "supervisor/geometry/outline.h"

namespace stepwright::ltl {
namespace {

using geometry::Point;
__extension__ using Wide = __int128;

// Where c lies of the line from a to b: 1 on its left, -1 on its right, 0 on it. Exact on the grid.
int side(Point a, Point b, Point c) {
  const auto steps = [](double from_m, double to_m) {
    return static_cast<Wide>(std::llround(to_m / kGrid_m)) - std::llround(from_m / kGrid_m);
  };
  const Wide turn = steps(a.x_m, b.x_m) * steps(a.y_m, c.y_m) - steps(a.y_m, b.y_m) * steps(a.x_m, c.x_m);
  return turn > 0 ? 1 : turn < 0 ? -1 : 0;
}

Point cyclic(const Ring& ring, std::size_t i) {
  return ring[i % ring.size()];
}

// Whether the way from corner i towards `to` begins in the interior, which is on the left of all sides.
bool leaves_inside(const Ring& ring, std::size_t i, Point to) {
  const Point at = ring[i], before = cyclic(ring, i + ring.size() - 1), behind = cyclic(ring, i + 1);
  const bool left_of_next = side(at, behind, to) > 0;
  const bool left_of_last = side(before, at, to) > 0;
  const int corner = side(before, at, behind);
  const bool turns_back = corner == 0 && dot(at - before, behind - at) < 0.0;
  return corner > 0 && !turns_back ? left_of_next && left_of_last : left_of_next || left_of_last;
}

// Whether p lies between a and b, on the line through them.
bool between(Point a, Point b, Point p) {
  return side(a, b, p) == 0 && dot(p - a, p - b) < 0.0;
}

// Whether what lies between two points is apart from a box.
bool apart(Point a, Point b, Point low, Point high) {
  return std::max(a.x_m, b.x_m) < low.x_m || std::min(a.x_m, b.x_m) > high.x_m ||
         std::max(a.y_m, b.y_m) < low.y_m || std::min(a.y_m, b.y_m) > high.y_m;
}

// Whether the open segments share a point, or one of the ring's corners lies within the first.
bool blocks(const Ring& ring, Point a, Point b) {
  const Point low{std::min(a.x_m, b.x_m), std::min(a.y_m, b.y_m)};
  const Point high{std::max(a.x_m, b.x_m), std::max(a.y_m, b.y_m)};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point c = ring[i], d = ring[i + 1 < ring.size() ? i + 1 : 0];
    if (apart(c, d, low, high)) continue;
    if (between(a, b, c)) return true;
    if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) return true;
  }
  return false;
}

// Behind corner `into` of the ring; the hole from its corner `from` on.
struct Joint {
  std::size_t into;
  std::size_t from;
};

std::optional<Joint> shared_corner(const Ring& ring, const Ring& hole) {
  for (std::size_t k = 0; k < hole.size(); ++k) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (ring[i] == hole[k] && leaves_inside(ring, i, cyclic(hole, k + 1))) return Joint{i, k};
    }
  }
  return std::nullopt;
}

void join(Ring& ring, const Ring& hole, Joint joint) {
  Ring way;
  const bool bridge = ring[joint.into] != hole[joint.from];
  for (std::size_t k = bridge ? 0 : 1; k <= hole.size(); ++k) way.push_back(cyclic(hole, joint.from + k));
  if (bridge) way.push_back(ring[joint.into]);
  ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(joint.into) + 1, way.begin(), way.end());
}

// Of the holes the one that begins farthest to the left, so that none lies between it and the ring.
std::size_t leftmost_corner(const Ring& ring) {
  const auto less = [](Point a, Point b) { return std::pair(a.x_m, a.y_m) < std::pair(b.x_m, b.y_m); };
  return static_cast<std::size_t>(std::ranges::min_element(ring, less) - ring.begin());
}

// The nearest corner of the ring that sees the hole's leftmost one.
Joint shortest_bridge(const Ring& ring, std::span<const Ring> holes, std::span<const geometry::Box> boxes) {
  const std::size_t from = leftmost_corner(holes.front());
  const Point to = holes.front()[from];
  std::vector<std::pair<double, std::size_t>> nearest(ring.size());
  for (std::size_t i = 0; i < ring.size(); ++i) nearest[i] = {dot(ring[i] - to, ring[i] - to), i};
  const auto blocked = [&](Point at) {
    if (blocks(ring, at, to)) return true;
    for (std::size_t k = 0; k < holes.size(); ++k)
      if (!apart(at, to, boxes[k].low, boxes[k].high) && blocks(holes[k], at, to)) return true;
    return false;
  };
  // Some at a time: nearly always one of the first ones will do.
  for (std::size_t known = 0; known < nearest.size();) {
    const std::size_t end = std::min(nearest.size(), 4 * known + 16);
    std::partial_sort(nearest.begin() + static_cast<std::ptrdiff_t>(known),
                      nearest.begin() + static_cast<std::ptrdiff_t>(end), nearest.end());
    for (; known < end; ++known) {
      const std::size_t i = nearest[known].second;
      if (!leaves_inside(ring, i, to) || !leaves_inside(holes.front(), from, ring[i])) continue;
      if (!blocked(ring[i])) return {i, from};
    }
  }
  return {nearest.front().second, from};  // rings that cross: what follows finds that areas differ
}

// Holes that touch one another become one, and those that touch the outline a part of it.
void join_touching(std::vector<Ring>& rings, const Stop& stop) {
  std::vector<geometry::Box> boxes;
  for (const Ring& ring : rings) boxes.push_back(geometry::bounds_of(ring));
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (stop && stop()) throw Stopped{};
    for (std::size_t k = i + 1; k < rings.size();) {
      const bool is_far = apart(boxes[i].low, boxes[i].high, boxes[k].low, boxes[k].high);
      const auto joint = is_far ? std::nullopt : shared_corner(rings[i], rings[k]);
      if (joint) {
        join(rings[i], rings[k], *joint);
        extend(boxes[i], boxes[k].low);
        extend(boxes[i], boxes[k].high);
        rings.erase(rings.begin() + static_cast<std::ptrdiff_t>(k));
        boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(k));
      }
      k = joint ? i + 1 : k + 1;
    }
  }
}

void turn_anticlockwise(Ring& ring, bool anticlockwise) {
  if ((geometry::signed_area_m2(ring) > 0.0) != anticlockwise) std::ranges::reverse(ring);
}

}  // namespace

Ring single_ring(std::vector<Ring> rings, const Stop& stop) {
  for (Ring& ring : rings) turn_anticlockwise(ring, &ring == &rings.front());
  join_touching(rings, stop);
  const std::span<Ring> holes = std::span(rings).subspan(1);
  std::ranges::stable_sort(holes, {}, [](const Ring& each) { return each[leftmost_corner(each)].x_m; });
  std::vector<geometry::Box> boxes;
  for (const Ring& each : holes) boxes.push_back(geometry::bounds_of(each));
  for (std::size_t k = 0; k < holes.size(); ++k) {
    if (stop && stop()) throw Stopped{};
    const Joint joint = shortest_bridge(rings.front(), holes.subspan(k), std::span(boxes).subspan(k));
    join(rings.front(), holes[k], joint);
  }
  return std::move(rings.front());
}

}  // namespace stepwright::ltl
