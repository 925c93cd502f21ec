#include "supervisor/geometry/union_outlines.h"

#include <boost/geometry/algorithms/append.hpp>
#include <boost/geometry/algorithms/area.hpp>
#include <boost/geometry/algorithms/correct.hpp>
#include <boost/geometry/algorithms/perimeter.hpp>
#include <boost/geometry/algorithms/simplify.hpp>
#include <boost/geometry/algorithms/union.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <cmath>
#include <utility>

namespace stepwright::geometry {
namespace {

namespace bg = boost::geometry;
using Corner = bg::model::d2::point_xy<double>;
using Region = bg::model::polygon<Corner, /*ClockWise=*/false>;
using Regions = bg::model::multi_polygon<Region>;

Regions region_of(const ConvexPolygon& polygon) {
  Region region;
  for (const Point p : polygon.corners()) bg::append(region.outer(), Corner(p.x_m, p.y_m));
  bg::correct(region);
  return {std::move(region)};
}

// By halves: a small region is not held against all the others again and again.
Regions united(std::span<const ConvexPolygon> regions) {
  if (regions.empty()) return {};
  if (regions.size() == 1) return region_of(regions.front());
  const std::size_t half = regions.size() / 2;
  Regions both;
  bg::union_(united(regions.first(half)), united(regions.subspan(half)), both);
  return both;
}

// Wider than the tolerance everywhere that matters: its area tells, as it is at least as long as wide.
template <typename Ring>
void add_ring(const Ring& ring, double tolerance_m, std::vector<std::vector<Point>>& outlines) {
  Ring simple;
  bg::simplify(ring, simple, tolerance_m);
  const double area_m2 = std::abs(bg::area(simple));
  if (simple.size() < 4 || area_m2 <= 0.5 * tolerance_m * bg::perimeter(simple)) return;
  std::vector<Point> outline;
  for (const Corner& corner : simple) outline.push_back({corner.x(), corner.y()});
  outline.pop_back();
  outlines.push_back(std::move(outline));
}

}  // namespace

std::vector<std::vector<Point>> union_outlines(std::span<const ConvexPolygon> regions, double tolerance_m) {
  std::vector<std::vector<Point>> outlines;
  for (const Region& region : united(regions)) {
    add_ring(region.outer(), tolerance_m, outlines);
    for (const auto& hole : region.inners()) add_ring(hole, tolerance_m, outlines);
  }
  return outlines;
}

}  // namespace stepwright::geometry
