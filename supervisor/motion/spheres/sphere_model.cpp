#include "supervisor/motion/spheres/sphere_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "supervisor/motion/mesh/solids.h"
#include "supervisor/motion/spheres/body_pieces.h"

namespace stepwright::motion {

namespace {

// How far a body reaches in directions all around: at right angles to its largest faces, where spheres stand
// out most, and evenly besides (a spiral).
class Hull {
 public:
  explicit Hull(const TriangleMesh& body) {
    add_faces(body);
    for (std::size_t k = 0; k < kSpiral; ++k) {
      const double z = 1.0 - (2.0 * static_cast<double>(k) + 1.0) / kSpiral;
      const double angle = std::numbers::pi * (3.0 - std::sqrt(5.0)) * static_cast<double>(k);
      const double r = std::sqrt(1.0 - z * z);
      directions_.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
    for (const Vector3& direction : directions_) {
      double reach = -std::numeric_limits<double>::infinity();
      for (const Vector3& each : body.points) reach = std::max(reach, dot(direction, each));
      reach_.push_back(reach);
    }
  }

  // How far a sphere stands out of the body's hull.
  double protrusion(const Sphere& sphere) const {
    double most = 0.0;
    for (std::size_t k = 0; k < directions_.size(); ++k)
      most = std::max(most, dot(directions_[k], sphere.centre_m) + sphere.radius_m - reach_[k]);
    return most;
  }

 private:
  static constexpr std::size_t kSpiral = 64, kFaces = 128;

  void add_faces(const TriangleMesh& body) {
    std::vector<std::pair<double, Vector3>> faces;
    for (std::size_t t = 0; t < body.triangles.size(); ++t) {
      const auto [a, b, c] = body.corners(t);
      const Vector3 normal = cross(b - a, c - a);
      if (const double size = length(normal); size > 0.0) faces.emplace_back(size, (1.0 / size) * normal);
    }
    std::stable_sort(faces.begin(), faces.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    constexpr double kAlike = 0.995;
    for (std::size_t k = 0; k < faces.size() && directions_.size() < kFaces; ++k)
      if (std::none_of(directions_.begin(), directions_.end(),
                       [&](const Vector3& known) { return dot(known, faces[k].second) > kAlike; }))
        directions_.push_back(faces[k].second);
  }

  std::vector<Vector3> directions_;
  std::vector<double> reach_;
};

struct Covered {
  BodyPiece piece;
  Sphere sphere;
  double protrusion_m = 0.0;
};

class Cover {
 public:
  Cover(const TriangleMesh& body, const CoverOptions& options)
      : options_(options), hull_(body), cutter_(body) {}

  std::vector<Sphere> run() {
    pieces_.push_back(covered(cutter_.whole()));
    while (pieces_.size() < options_.most_per_body) {
      const auto worst = std::max_element(
          pieces_.begin(), pieces_.end(),
          [](const Covered& a, const Covered& b) { return a.protrusion_m < b.protrusion_m; });
      if (worst->protrusion_m <= options_.protrusion_m) break;
      if (!divide(static_cast<std::size_t>(worst - pieces_.begin()))) break;
    }
    merge();
    return spheres();
  }

 private:
  // Neighbours that one sphere covers without standing out further than is allowed, or than one of them does.
  void merge() {
    std::vector<std::vector<Vector3>> points;
    for (const Covered& each : pieces_) points.push_back(each.piece.points());
    for (std::size_t a = 0; a < pieces_.size(); ++a)
      for (std::size_t b = 0; b < pieces_.size(); ++b) {
        if (a == b) continue;
        Covered &one = pieces_[a], &other = pieces_[b];
        const double allowed = std::max({options_.protrusion_m, one.protrusion_m, other.protrusion_m});
        if (distance(one.sphere.centre_m, other.sphere.centre_m) >
            one.sphere.radius_m + other.sphere.radius_m)
          continue;
        std::vector<Vector3> both = points[a];
        both.insert(both.end(), points[b].begin(), points[b].end());
        const Sphere sphere = enclosing_sphere(both);
        const double protrusion = hull_.protrusion(sphere);
        if (protrusion > allowed) continue;
        one.sphere = sphere;
        one.protrusion_m = protrusion;
        points[a] = std::move(both);
        pieces_.erase(pieces_.begin() + static_cast<std::ptrdiff_t>(b));
        points.erase(points.begin() + static_cast<std::ptrdiff_t>(b));
        if (b < a) --a;
        b = static_cast<std::size_t>(-1);  // from the first one again
      }
  }

  Covered covered(BodyPiece piece) const {
    const Sphere sphere = enclosing_sphere(piece.points());
    const double protrusion = hull_.protrusion(sphere);
    return {std::move(piece), sphere, protrusion};
  }

  // Cuts across the middle, along the axis after which the parts stand out least.
  bool divide(std::size_t which) {
    std::vector<Covered> best;
    double best_measure = std::numeric_limits<double>::infinity();
    const BodyPiece& piece = pieces_[which].piece;
    const auto points = piece.points();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto along = [&](const Vector3& p) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; };
      const auto [low, high] =
          std::minmax_element(points.begin(), points.end(),
                              [&](const Vector3& a, const Vector3& b) { return along(a) < along(b); });
      const double from = along(*low), to = along(*high);
      constexpr double kThinnest_m = 1e-3;
      if (!(to - from > kThinnest_m)) continue;
      auto [below, above] = cutter_.cut(piece, axis, 0.5 * (from + to));
      std::vector<Covered> parts;
      for (BodyPiece* each : {&below, &above})
        if (!each->empty()) parts.push_back(covered(std::move(*each)));
      double measure = 0.0, sum = 0.0;
      for (const Covered& each : parts) {
        measure = std::max(measure, each.protrusion_m);
        sum += each.sphere.radius_m;
      }
      measure += 0.1 * sum;
      if (measure < best_measure) best_measure = measure, best = std::move(parts);
    }
    if (best.empty()) return false;
    pieces_[which] = std::move(best[0]);
    if (best.size() > 1) pieces_.push_back(std::move(best[1]));
    return true;
  }

  // Those that no other one contains.
  std::vector<Sphere> spheres() const {
    std::vector<Sphere> all;
    for (const Covered& each : pieces_) all.push_back(each.sphere);
    std::stable_sort(all.begin(), all.end(),
                     [](const Sphere& a, const Sphere& b) { return a.radius_m > b.radius_m; });
    std::vector<Sphere> kept;
    for (const Sphere& each : all)
      if (std::none_of(kept.begin(), kept.end(), [&](const Sphere& other) {
            return distance(each.centre_m, other.centre_m) + each.radius_m <= other.radius_m;
          }))
        kept.push_back(each);
    put_neighbours_together(kept);
    return kept;
  }

  const CoverOptions& options_;
  Hull hull_;
  BodyPieces cutter_;
  std::vector<Covered> pieces_;
};

}  // namespace

// Around spheres: their centres' sphere is a start; each then takes in what stands out.
Sphere bound_of(const std::vector<Sphere>& spheres) {
  std::vector<Vector3> centres;
  for (const Sphere& each : spheres) centres.push_back(each.centre_m);
  Sphere bound = enclosing_sphere(centres);
  bound.radius_m = 0.0;
  for (const Sphere& each : spheres)
    bound.radius_m = std::max(bound.radius_m, distance(each.centre_m, bound.centre_m) + each.radius_m);
  return bound;
}

// Halves across the longest way, each of whole groups.
void put_neighbours_together(std::span<Sphere> spheres) {
  if (spheres.size() <= kSpheresTogether) return;
  const auto along = [](const Sphere& each, std::size_t axis) {
    return axis == 0 ? each.centre_m.x : axis == 1 ? each.centre_m.y : each.centre_m.z;
  };
  std::size_t longest = 0;
  double most = -1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::ranges::minmax_element(
        spheres, [&](const Sphere& a, const Sphere& b) { return along(a, axis) < along(b, axis); });
    if (const double far = along(*high, axis) - along(*low, axis); far > most) most = far, longest = axis;
  }
  std::ranges::stable_sort(
      spheres, [&](const Sphere& a, const Sphere& b) { return along(a, longest) < along(b, longest); });
  const std::size_t groups = (spheres.size() + kSpheresTogether - 1) / kSpheresTogether;
  const std::size_t half = groups / 2 * kSpheresTogether;
  put_neighbours_together(spheres.first(half));
  put_neighbours_together(spheres.subspan(half));
}

TriangleMesh surface_of(const Body& body) {
  const Shape& shape = body.shape;
  switch (shape.kind) {
    case ShapeKind::Box:
      return moved(box_mesh(shape.size_m), shape.origin);
    case ShapeKind::Cylinder:
      return moved(prism_around_cylinder(shape.radius_m, shape.length_m), shape.origin);
    default:
      return body.mesh ? moved(*body.mesh, shape.origin) : TriangleMesh{};
  }
}

std::vector<Sphere> cover(const TriangleMesh& body, const CoverOptions& options) {
  if (body.triangles.empty()) return {};
  return Cover(body, options).run();
}

SphereModel cover(const Bodies& bodies, const CoverOptions& options) {
  SphereModel model;
  for (const std::vector<Body>& link : bodies) {
    LinkSpheres covered;
    for (const Body& body : link) {
      if (body.shape.kind == ShapeKind::Sphere) {
        covered.spheres.push_back({body.shape.origin.position_m, body.shape.radius_m});
        continue;
      }
      // In the body's own frame, along whose axes a box or cylinder is best cut.
      Body at_origin = body;
      at_origin.shape.origin = {};
      for (const Sphere& each : cover(surface_of(at_origin), options))
        covered.spheres.push_back({body.shape.origin * each.centre_m, each.radius_m});
    }
    put_neighbours_together(covered.spheres);
    if (!covered.spheres.empty()) covered.bound = bound_of(covered.spheres);
    model.links.push_back(std::move(covered));
  }
  return model;
}

}  // namespace stepwright::motion
