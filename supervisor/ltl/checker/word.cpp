#include <algorithm>
#include <cmath>
#include <vector>

#include "supervisor/ltl/checker/internal/within.h"
#include "supervisor/ltl/checker/plan_checker.h"

namespace stepwright::ltl {

using geometry::Point;

namespace internal {

bool within(std::span<const Point> ring, Point at) {
  bool in = false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point a = ring[k], b = ring[(k + 1) % ring.size()];
    if ((a.y_m <= at.y_m) != (b.y_m <= at.y_m) && (cross(b - a, at - a) > 0.0) == (b.y_m > a.y_m)) in = !in;
  }
  return in;
}

}  // namespace internal

namespace {

constexpr double kNothing = 1e-9;  // share of a way that is no part of it

// Where the way meets the line through two points, as a share of it; ends of the side count with some slack,
// as a cut too many changes nothing.
void cut(Point a, Point b, Point from, Point to, std::vector<double>& cuts) {
  const double before = cross(b - a, from - a), after = cross(b - a, to - a);
  if (before == after || (before > 0.0) == (after > 0.0)) return;
  const double share = before / (before - after);
  const Point at = from + share * (to - from);
  const double along = dot(at - a, b - a) / dot(b - a, b - a);
  if (along > -0.01 && along < 1.01) cuts.push_back(share);
}

Label label_at(const std::vector<Area>& propositions, Point at) {
  Label label = 0;
  for (std::size_t k = 0; k < propositions.size(); ++k)
    if (internal::within(propositions[k].ring, at)) label |= Label{1} << k;
  return label;
}

}  // namespace

void read_way(const std::vector<Area>& propositions, Point from, Point to, std::vector<Label>& word) {
  std::vector<double> cuts = {0.0, 1.0};
  for (const Area& area : propositions)
    for (std::size_t k = 0; k < area.ring.size(); ++k)
      cut(area.ring[k], area.ring[(k + 1) % area.ring.size()], from, to, cuts);
  std::ranges::sort(cuts);
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    if (cuts[k + 1] - cuts[k] < kNothing) continue;
    const Label label = label_at(propositions, from + 0.5 * (cuts[k] + cuts[k + 1]) * (to - from));
    if (word.empty() || word.back() != label) word.push_back(label);
  }
}

}  // namespace stepwright::ltl
