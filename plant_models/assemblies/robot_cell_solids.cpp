#include "plant_models/assemblies/robot_cell_solids.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace stepwright::assemblies {
namespace {

constexpr int kMostRounds = 64;
constexpr double kNearEnough = 1e-10;  // of the distance
constexpr double kTouching_m2 = 1e-20;
constexpr double kFlat_m3 = 1e-15;  // of a tetrahedron

ConvexSolid grown(SolidKind kind, Vec3 half_m, double least_m) {
  const double round_m = std::min(kCornerRound_m, least_m);
  return {kind, {half_m.x - round_m, half_m.y - round_m, half_m.z - round_m}, round_m};
}

// The farthest point of the core in a direction, in the solid's frame.
Vec3 farthest_of_core(const ConvexSolid& solid, Vec3 way) {
  const double z = way.z < 0.0 ? -solid.half_m.z : solid.half_m.z;
  if (solid.kind == SolidKind::Box) {
    return {way.x < 0.0 ? -solid.half_m.x : solid.half_m.x, way.y < 0.0 ? -solid.half_m.y : solid.half_m.y,
            z};
  }
  const double across = std::sqrt(way.x * way.x + way.y * way.y);
  if (!(across > 0.0)) return {0.0, 0.0, z};
  const double k = solid.half_m.x / across;
  return {k * way.x, k * way.y, z};
}

Vec3 farthest(const PlacedSolid& placed, Vec3 way) {
  return placed.frame * farthest_of_core(placed.solid, placed.frame.turn.back(way));
}

// Up to four points of the difference of both cores, and the point of their hull that is nearest to the
// origin.
class NearestHull {
 public:
  Vec3 nearest() const { return nearest_; }
  bool around_origin() const { return around_; }

  bool has(Vec3 point) const {
    return std::any_of(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(count_),
                       [&](Vec3 each) { return each == point; });
  }
  // Keeps only the points that the nearest one lies between.
  void add(Vec3 point) {
    points_[count_++] = point;
    if (count_ == 1) nearest_ = point;
    if (count_ == 2) of_line(points_[0], points_[1]);
    if (count_ == 3) of_triangle(points_[0], points_[1], points_[2]);
    if (count_ == 4) of_tetrahedron();
  }

 private:
  void keep(std::initializer_list<Vec3> points, Vec3 nearest) {
    count_ = 0;
    for (const Vec3 point : points) points_[count_++] = point;
    nearest_ = nearest;
  }

  void of_line(Vec3 a, Vec3 b) {
    const Vec3 ab = b - a;
    const double along = -dot(a, ab);
    const double whole = dot(ab, ab);
    if (along <= 0.0) return keep({a}, a);
    if (along >= whole) return keep({b}, b);
    keep({a, b}, a + (along / whole) * ab);
  }

  // By the regions of Voronoi (C. Ericson, Real-Time Collision Detection, 2005, section 5.1.5).
  void of_triangle(Vec3 a, Vec3 b, Vec3 c) {
    const Vec3 ab = b - a;
    const Vec3 ac = c - a;
    const double a_b = -dot(ab, a), a_c = -dot(ac, a);
    if (a_b <= 0.0 && a_c <= 0.0) return keep({a}, a);
    const double b_b = -dot(ab, b), b_c = -dot(ac, b);
    if (b_b >= 0.0 && b_c <= b_b) return keep({b}, b);
    const double of_c = a_b * b_c - b_b * a_c;
    if (of_c <= 0.0 && a_b >= 0.0 && b_b <= 0.0) return of_line(a, b);
    const double c_b = -dot(ab, c), c_c = -dot(ac, c);
    if (c_c >= 0.0 && c_b <= c_c) return keep({c}, c);
    const double of_b = c_b * a_c - a_b * c_c;
    if (of_b <= 0.0 && a_c >= 0.0 && c_c <= 0.0) return of_line(a, c);
    const double of_a = b_b * c_c - c_b * b_c;
    if (of_a <= 0.0 && b_c - b_b >= 0.0 && c_b - c_c >= 0.0) return of_line(b, c);
    const double whole = of_a + of_b + of_c;
    keep({a, b, c}, a + (of_b / whole) * ab + (of_c / whole) * ac);
  }

  void of_tetrahedron() {
    const std::array<Vec3, 4> p = points_;
    constexpr std::array<std::array<std::size_t, 4>, 4> kFaces = {
        {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}}};
    NearestHull best;
    double least = 0.0;
    for (const auto& [i, j, k, opposite] : kFaces) {
      const Vec3 normal = cross(p[j] - p[i], p[k] - p[i]);
      const double inside = dot(normal, p[opposite] - p[i]);
      const double here = -dot(normal, p[i]);
      if (inside * here > 0.0 && std::abs(inside) > kFlat_m3) continue;  // on the side of the opposite point
      NearestHull face;
      face.of_triangle(p[i], p[j], p[k]);
      const double square = dot(face.nearest_, face.nearest_);
      if (best.count_ > 0 && square >= least) continue;
      best = face;
      least = square;
    }
    if (best.count_ == 0) {
      around_ = true;
      nearest_ = {};
    } else {
      *this = best;
    }
  }

  std::array<Vec3, 4> points_{};
  std::size_t count_ = 0;
  Vec3 nearest_;
  bool around_ = false;
};

double core_distance_m(const PlacedSolid& a, const PlacedSolid& b) {
  const auto difference = [&](Vec3 way) { return farthest(a, way) - farthest(b, -way); };
  NearestHull hull;
  hull.add(difference(b.frame.place - a.frame.place));
  for (int round = 0; round < kMostRounds; ++round) {
    const Vec3 nearest = hull.nearest();
    const double square = dot(nearest, nearest);
    if (hull.around_origin() || square < kTouching_m2) return 0.0;
    const Vec3 next = difference(-nearest);
    if (square - dot(nearest, next) <= kNearEnough * square || hull.has(next)) break;
    NearestHull grown_hull = hull;
    grown_hull.add(next);
    // Rounding may keep it from coming nearer: then it is as near as it gets.
    if (!grown_hull.around_origin() && !(dot(grown_hull.nearest(), grown_hull.nearest()) < square)) break;
    hull = grown_hull;
  }
  return length(hull.nearest());
}

}  // namespace

ConvexSolid box_solid(Vec3 sides_m) {
  const Vec3 half = 0.5 * sides_m;
  return grown(SolidKind::Box, half, std::min({half.x, half.y, half.z}));
}

ConvexSolid cylinder_solid(double radius_m, double length_m) {
  return grown(SolidKind::Cylinder, {radius_m, radius_m, 0.5 * length_m}, std::min(radius_m, 0.5 * length_m));
}

ConvexSolid ball_solid(double radius_m) {
  return {SolidKind::Box, {}, radius_m};
}

double bound_m(const ConvexSolid& solid) {
  const Vec3 h = solid.half_m;
  const double across = solid.kind == SolidKind::Box ? h.x * h.x + h.y * h.y : h.x * h.x;
  return std::sqrt(across + h.z * h.z) + solid.round_m;
}

double solid_distance_m(const PlacedSolid& a, const PlacedSolid& b) {
  return core_distance_m(a, b) - a.solid.round_m - b.solid.round_m;
}

}  // namespace stepwright::assemblies
