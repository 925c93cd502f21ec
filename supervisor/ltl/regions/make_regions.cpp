#include "supervisor/ltl/regions/make_regions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "supervisor/ltl/regions/geos.h"
#include "supervisor/ltl/regions/single_ring.h"

namespace stepwright::ltl {
namespace {

using geometry::Point;
using result::Diagnostics;
using result::Location;
using result::Severity;

constexpr double kFarthest_m = 1e6;  // beyond it a double does not hold micrometres well

void complain(Diagnostics& wrong, std::string code, const Location& where, std::string message,
              std::string hint) {
  wrong.push_back({std::move(code), Severity::Error, where, std::move(message), std::move(hint)});
}

bool read_ring(const Area& area, Diagnostics& wrong) {
  if (area.ring.size() < 3) {
    complain(wrong, "L0201", area.where, "'" + area.name + "' has fewer than three points",
             "an area is a polygon");
    return false;
  }
  const bool usable = std::ranges::all_of(
      area.ring, [](Point p) { return std::abs(p.x_m) <= kFarthest_m && std::abs(p.y_m) <= kFarthest_m; });
  if (!usable) {
    complain(wrong, "L0202", area.where, "'" + area.name + "' has a coordinate that is no length in metres",
             "coordinates are finite and within 1000 km");
  }
  return usable;
}

// On the grid, so that what touches does so exactly.
std::optional<Shape> read_area(const Geos& geos, const Area& area, Diagnostics& wrong) {
  if (!read_ring(area, wrong)) return std::nullopt;
  std::vector<Point> ring = area.ring;
  for (Point& p : ring) p = {std::round(p.x_m / kGrid_m) * kGrid_m, std::round(p.y_m / kGrid_m) * kGrid_m};
  Shape shape = geos.polygon(ring);
  char* reason = nullptr;
  GEOSGeometry* at = nullptr;
  const char valid = GEOSisValidDetail_r(geos, shape.get(), 0, &reason, &at);
  const std::string said = reason != nullptr ? reason : "";
  GEOSFree_r(geos, reason);
  const Shape place(at, Geos::Destroy{geos});
  if (geos.answer(valid)) return shape;
  std::string message = "the outline of '" + area.name + "' is not simple: " + said;
  double x = 0.0, y = 0.0;
  if (place != nullptr && GEOSGeomGetX_r(geos, place.get(), &x) == 1 &&
      GEOSGeomGetY_r(geos, place.get(), &y) == 1)
    message += " at (" + std::to_string(x) + ", " + std::to_string(y) + ")";
  complain(wrong, "L0203", area.where, message, "an outline meets itself at its first point only");
  return std::nullopt;
}

struct Shapes {
  std::optional<Shape> border;
  std::vector<Shape> obstacles;
  std::vector<Shape> propositions;
};

void look_at(const Stop& stop) {
  if (stop && stop()) throw Stopped{};
}

bool apart(const geometry::Box& a, const geometry::Box& b) {
  return a.low.x_m > b.high.x_m || a.high.x_m < b.low.x_m || a.low.y_m > b.high.y_m || a.high.y_m < b.low.y_m;
}

// With some micrometres around them, which the grid may move corners by.
std::vector<geometry::Box> boxes_of(const std::vector<Area>& areas) {
  std::vector<geometry::Box> boxes;
  const Point grid{2.0 * kGrid_m, 2.0 * kGrid_m};
  for (const Area& each : areas) {
    geometry::Box box = geometry::bounds_of(each.ring);
    boxes.push_back({box.low - grid, box.high + grid});
  }
  return boxes;
}

void check_propositions(const Geos& geos, const Floor& floor, const Shapes& shapes, Diagnostics& wrong) {
  const std::vector<geometry::Box> obstacles = boxes_of(floor.obstacles);
  const std::vector<geometry::Box> places = boxes_of(floor.propositions);
  for (std::size_t i = 0; i < floor.propositions.size(); ++i) {
    const Area& area = floor.propositions[i];
    const GEOSGeometry* shape = shapes.propositions[i].get();
    if (!geos.answer(GEOSCovers_r(geos, shapes.border->get(), shape)))
      complain(wrong, "L0204", area.where, "'" + area.name + "' reaches beyond the border",
               "propositions lie within the border");
    for (std::size_t k = 0; k < floor.obstacles.size(); ++k) {
      // Inner points in common; that the two touch is no fault.
      if (!apart(obstacles[k], places[i]) &&
          geos.answer(GEOSRelatePattern_r(geos, shapes.obstacles[k].get(), shape, "T********")))
        complain(wrong, "L0204", area.where,
                 "'" + area.name + "' meets the obstacle '" + floor.obstacles[k].name + "'",
                 "a proposition holds on free floor; cut the obstacle out of it");
    }
  }
}

// Whether there are not too many.
bool count_corners(const Floor& floor, Diagnostics& wrong) {
  std::size_t corners = floor.border.ring.size();
  const Area* beyond = corners > kMostCorners ? &floor.border : nullptr;
  for (const std::vector<Area>* areas : {&floor.obstacles, &floor.propositions}) {
    for (const Area& each : *areas) {
      corners += each.ring.size();
      if (corners > kMostCorners && beyond == nullptr) beyond = &each;
    }
  }
  if (beyond == nullptr) return true;
  complain(wrong, "L0208", beyond->where,
           "with '" + beyond->name + "' the floor has more than " + std::to_string(kMostCorners) +
               " corners, " + std::to_string(corners) + " in all",
           "simplify outlines, or leave out what no vehicle can reach");
  return false;
}

std::optional<Shapes> read_shapes(const Geos& geos, const Floor& floor, const Stop& stop,
                                  Diagnostics& wrong) {
  if (!count_corners(floor, wrong)) return std::nullopt;
  Shapes shapes;
  const auto read_all = [&](const std::vector<Area>& areas, std::vector<Shape>& into) {
    for (const Area& area : areas) {
      look_at(stop);
      if (auto shape = read_area(geos, area, wrong)) into.push_back(*std::move(shape));
    }
  };
  shapes.border = read_area(geos, floor.border, wrong);
  read_all(floor.obstacles, shapes.obstacles);
  read_all(floor.propositions, shapes.propositions);
  if (floor.propositions.size() > kMostPropositions)
    complain(wrong, "L0206", floor.propositions[kMostPropositions].where,
             "more than " + std::to_string(kMostPropositions) + " propositions", "use fewer areas");
  if (!wrong.empty()) return std::nullopt;
  check_propositions(geos, floor, shapes, wrong);
  if (!wrong.empty()) return std::nullopt;
  return shapes;
}

// The faces between all outlines.
Shape faces_of(const Geos& geos, const Shapes& shapes) {
  std::vector<Shape> lines;
  const auto add = [&](const Shape& shape) { lines.push_back(geos.own(GEOSBoundary_r(geos, shape.get()))); };
  add(*shapes.border);
  std::ranges::for_each(shapes.obstacles, add);
  std::ranges::for_each(shapes.propositions, add);
  const Shape all = geos.collection(GEOS_MULTILINESTRING, std::move(lines));
  const Shape noded = geos.own(GEOSUnaryUnionPrec_r(geos, all.get(), kGrid_m));
  const GEOSGeometry* parts[] = {noded.get()};
  return geos.own(GEOSPolygonize_r(geos, parts, 1));
}

// Collects triangles, with equal points as one.
class Collector {
 public:
  void add(std::span<const Point> ring, Label label) {
    Region region{.label = label};
    for (std::size_t k = 0; k < 3; ++k) region.corners[k] = index_of(ring[k]);
    const Point a = ring[0], b = ring[1], c = ring[2];
    if (cross(b - a, c - a) < 0.0) std::swap(region.corners[1], region.corners[2]);
    regions_.push_back(region);
  }

  RegionMap finish() { return {std::move(points_), std::move(regions_)}; }

 private:
  std::uint32_t index_of(Point p) {
    const auto [found, is_new] =
        indices_.try_emplace({p.x_m, p.y_m}, static_cast<std::uint32_t>(points_.size()));
    if (is_new) points_.push_back(p);
    return found->second;
  }

  std::map<std::pair<double, double>, std::uint32_t> indices_;
  std::vector<Point> points_;
  std::vector<Region> regions_;
};

double area_of(const Geos& geos, const GEOSGeometry* shape) {
  double area = 0.0;
  GEOSArea_r(geos, shape, &area);
  return area;
}

Ring ring_of(const Geos& geos, const GEOSGeometry* face, const Stop& stop) {
  std::vector<Ring> rings;
  const auto add = [&](const GEOSGeometry* line) {
    rings.push_back(geos.points_of(line));
    rings.back().pop_back();
  };
  add(GEOSGetExteriorRing_r(geos, face));
  const int holes = GEOSGetNumInteriorRings_r(geos, face);
  for (int i = 0; i < holes; ++i) add(GEOSGetInteriorRingN_r(geos, face, i));
  return single_ring(std::move(rings), stop);
}

void triangulate(const Geos& geos, const GEOSGeometry* face, Label label, const Stop& stop, Collector& into) {
  const Shape whole = geos.polygon(ring_of(geos, face, stop));
  const Shape triangles = geos.own(GEOSConstrainedDelaunayTriangulation_r(geos, whole.get()));
  const double difference = std::abs(area_of(geos, triangles.get()) - area_of(geos, face));
  if (difference > 1e-6 + 1e-9 * area_of(geos, face))
    throw GeosError("the triangles do not cover a face of the floor");
  const int count = GEOSGetNumGeometries_r(geos, triangles.get());
  for (int i = 0; i < count; ++i) {
    const GEOSGeometry* triangle = GEOSGetGeometryN_r(geos, triangles.get(), i);
    into.add(geos.points_of(GEOSGetExteriorRing_r(geos, triangle)), label);
  }
}

RegionMap cut(const Geos& geos, const Floor& floor, const Shapes& shapes, const Stop& stop) {
  Collector collector;
  const std::vector<geometry::Box> obstacles = boxes_of(floor.obstacles);
  look_at(stop);
  const Shape faces = faces_of(geos, shapes);
  const int count = GEOSGetNumGeometries_r(geos, faces.get());
  for (int i = 0; i < count; ++i) {
    const GEOSGeometry* face = GEOSGetGeometryN_r(geos, faces.get(), i);
    look_at(stop);
    const Shape inner = geos.own(GEOSPointOnSurface_r(geos, face));
    Point at;
    if (GEOSGeomGetX_r(geos, inner.get(), &at.x_m) != 1 || GEOSGeomGetY_r(geos, inner.get(), &at.y_m) != 1)
      throw GeosError("a face has no point");
    const auto holds = [&](const Shape& shape) {
      return geos.answer(GEOSContains_r(geos, shape.get(), inner.get()));
    };
    const auto is_covered = [&] {
      for (std::size_t k = 0; k < obstacles.size(); ++k)
        if (!apart(obstacles[k], {at, at}) && holds(shapes.obstacles[k])) return true;
      return false;
    };
    if (!holds(*shapes.border) || is_covered()) continue;
    Label label = 0;
    for (std::size_t k = 0; k < shapes.propositions.size(); ++k)
      if (holds(shapes.propositions[k])) label |= Label{1} << k;
    triangulate(geos, face, label, stop, collector);
  }
  return collector.finish();
}

}  // namespace

result::Result<void> check_outline(const Area& area) try {
  const Geos geos;
  Diagnostics wrong;
  if (!read_area(geos, area, wrong)) return tl::unexpected(std::move(wrong));
  return {};
} catch (const GeosError& error) {
  return result::fail("L0203", area.where,
                      "the outline of '" + area.name + "' is no polygon: " + error.what());
}

result::Result<RegionMap> make_regions(const Floor& floor, const std::function<bool()>& stop) try {
  const Geos geos;
  Diagnostics wrong;
  const auto shapes = read_shapes(geos, floor, stop, wrong);
  if (!shapes) return tl::unexpected(std::move(wrong));
  RegionMap map = cut(geos, floor, *shapes, stop);
  if (map.regions().empty())
    return result::fail("L0205", floor.border.where, "obstacles cover the whole floor",
                        "the border holds free floor");
  return map;
} catch (const Stopped&) {
  return result::fail(kStoppedRegions, floor.border.where, "the floor was not cut into triangles in time",
                      "more time, or fewer corners");
} catch (const GeosError& error) {
  return result::fail("L0207", floor.border.where,
                      std::string("the floor cannot be cut into triangles: ") + error.what(),
                      "move outlines that nearly touch apart, or let them share their points");
}

}  // namespace stepwright::ltl
