#include "supervisor/ltl/scene/places.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "supervisor/geometry/outline.h"

namespace stepwright::ltl {

using geometry::Point;

bool inside(std::span<const Point> ring, Point at) {
  bool in = false;
  for (std::size_t k = 0, before = ring.size() - 1; k < ring.size(); before = k++) {
    const Point a = ring[k], b = ring[before];
    if ((a.y_m > at.y_m) == (b.y_m > at.y_m)) continue;
    if (at.x_m < a.x_m + (b.x_m - a.x_m) * (at.y_m - a.y_m) / (b.y_m - a.y_m)) in = !in;
  }
  return in;
}

Places::Places(std::span<const Area> propositions) {
  for (const Area& area : propositions) outlines_.push_back({area.ring, geometry::bounds_of(area.ring)});
}

namespace {

// 0 where the two cross.
double distance_between_sides(Point a, Point b, Point c, Point d) {
  const double c_side = cross(b - a, c - a), d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c), b_side = cross(d - c, b - c);
  if (c_side * d_side < 0.0 && a_side * b_side < 0.0) return 0.0;
  return std::min({distance_to_side(a, c, d), distance_to_side(b, c, d), distance_to_side(c, a, b),
                   distance_to_side(d, a, b)});
}

bool apart(const geometry::Box& box, Point a, Point b, double margin_m) {
  return std::max(a.x_m, b.x_m) < box.low.x_m - margin_m ||
         std::min(a.x_m, b.x_m) > box.high.x_m + margin_m ||
         std::max(a.y_m, b.y_m) < box.low.y_m - margin_m || std::min(a.y_m, b.y_m) > box.high.y_m + margin_m;
}

}  // namespace

Label Places::label(Point at) const {
  Label found = 0;
  for (std::size_t k = 0; k < outlines_.size(); ++k)
    if (!apart(outlines_[k].bounds, at, at, 0.0) && inside(outlines_[k].ring, at)) found |= Label{1} << k;
  return found;
}

Label Places::read(Point from, Point to, Label here, std::vector<Label>& letters) const {
  thread_local std::vector<double> cuts;
  cuts.clear();
  bool met = false;
  for (const Outline& outline : outlines_) {
    if (apart(outline.bounds, from, to, 0.0)) continue;
    met = true;
    for (std::size_t k = 0, before = outline.ring.size() - 1; k < outline.ring.size(); before = k++) {
      const Point a = outline.ring[before], side = outline.ring[k] - a, way = to - from;
      const double across = cross(way, side);
      if (across == 0.0) continue;
      const double share = cross(a - from, side) / across;
      const double on_side = cross(a - from, way) / across;
      if (share > 0.0 && share < 1.0 && on_side >= 0.0 && on_side <= 1.0) cuts.push_back(share);
    }
  }
  if (!met) {
    if (here != 0) letters.push_back(0);
    return 0;
  }
  cuts.push_back(1.0);
  std::ranges::sort(cuts);
  double start = 0.0;
  Label last = here;
  const double length = geometry::distance(from, to);
  for (const double end : cuts) {
    if ((end - start) * length < 1e-9) continue;
    const Label now = label(from + 0.5 * (start + end) * (to - from));
    if (now != last) letters.push_back(now);
    last = now;
    start = end;
  }
  return last;
}

Label Places::near(Point from, Point to, double than_m) const {
  Label found = 0;
  for (std::size_t k = 0; k < outlines_.size(); ++k) {
    if (apart(outlines_[k].bounds, from, to, than_m)) continue;
    const auto& ring = outlines_[k].ring;
    bool close = inside(ring, from);
    for (std::size_t i = 0, before = ring.size() - 1; i < ring.size() && !close; before = i++)
      close = distance_between_sides(from, to, ring[before], ring[i]) < than_m;
    if (close) found |= Label{1} << k;
  }
  return found;
}

}  // namespace stepwright::ltl
