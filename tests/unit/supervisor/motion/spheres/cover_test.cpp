#include <gtest/gtest.h>

#include <algorithm>

#include "supervisor/motion/mesh/solids.h"
#include "supervisor/motion/spatial/random.h"
#include "supervisor/motion/spheres/body_pieces.h"
#include "supervisor/motion/spheres/sphere_model.h"
#include "tests/unit/supervisor/motion/robots.h"

namespace stepwright::motion {
namespace {

constexpr int kSamplesPerLink = 100'000;

// Points of a body's true surface, evenly over its area: of cylinders and spheres the round one.
class Surface {
 public:
  explicit Surface(const std::vector<Body>& bodies) : bodies_(bodies) {
    for (const Body& body : bodies) {
      const Shape& shape = body.shape;
      double area = 0.0;
      std::vector<double> sums;
      if (shape.kind == ShapeKind::Cylinder)
        area = 6.28 * shape.radius_m * (shape.radius_m + shape.length_m);
      else if (shape.kind == ShapeKind::Sphere)
        area = 12.57 * shape.radius_m * shape.radius_m;
      else {
        meshes_.push_back(surface_of(body));
        for (std::size_t t = 0; t < meshes_.back().triangles.size(); ++t)
          sums.push_back(area += area_m2(meshes_.back().corners(t)));
      }
      if (sums.empty()) meshes_.emplace_back();
      area_sums_.push_back(std::move(sums));
      bounds_.push_back(total_ += area);
    }
  }

  Vector3 draw(Random& random) const {
    const auto found = std::upper_bound(bounds_.begin(), bounds_.end(), random.between(0, total_));
    const auto which =
        std::min<std::size_t>(static_cast<std::size_t>(found - bounds_.begin()), bodies_.size() - 1);
    const Shape& shape = bodies_[which].shape;
    if (shape.kind == ShapeKind::Sphere) return shape.origin * (shape.radius_m * direction(random));
    if (shape.kind == ShapeKind::Cylinder) return shape.origin * of_cylinder(shape, random);
    const auto& sums = area_sums_[which];
    const auto t = std::upper_bound(sums.begin(), sums.end(), random.between(0, sums.back())) - sums.begin();
    const auto [a, b, c] = meshes_[which].corners(std::min(static_cast<std::size_t>(t), sums.size() - 1));
    double u = random.unit(), v = random.unit();
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    return a + u * (b - a) + v * (c - a);
  }

 private:
  static Vector3 direction(Random& random) {
    for (;;) {
      const Vector3 d{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
      if (const double l = length(d); l > 0.1 && l < 1.0) return normalised(d);
    }
  }
  static Vector3 of_cylinder(const Shape& shape, Random& random) {
    const double angle = random.between(0, 6.283185307), r = shape.radius_m, half = 0.5 * shape.length_m;
    const bool on_end = random.between(0, r + shape.length_m) < r;
    const double from_axis = on_end ? r * std::sqrt(random.unit()) : r;
    const double z = on_end ? (random.unit() < 0.5 ? -half : half) : random.between(-half, half);
    return {from_axis * std::cos(angle), from_axis * std::sin(angle), z};
  }

  const std::vector<Body>& bodies_;
  std::vector<TriangleMesh> meshes_;
  std::vector<std::vector<double>> area_sums_;
  std::vector<double> bounds_;
  double total_ = 0.0;
};

bool contains(const std::vector<Sphere>& spheres, const Vector3& point) {
  return std::any_of(spheres.begin(), spheres.end(), [&](const Sphere& each) {
    const Vector3 to = point - each.centre_m;
    return length(to) <= each.radius_m + 1e-12;  // of a body that is a sphere every point is on the border
  });
}

void expect_all_inside(const Bodies& bodies, const SphereModel& model, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t link = 0; link < bodies.size(); ++link) {
    if (bodies[link].empty()) {
      EXPECT_TRUE(model.links[link].spheres.empty());
      continue;
    }
    const Surface surface(bodies[link]);
    int outside = 0;
    for (int k = 0; k < kSamplesPerLink; ++k)
      outside += !contains(model.links[link].spheres, surface.draw(random));
    EXPECT_EQ(outside, 0) << "link " << link;
    for (const Sphere& each : model.links[link].spheres)
      EXPECT_LE(distance(each.centre_m, model.links[link].bound.centre_m) + each.radius_m,
                model.links[link].bound.radius_m + 1e-12);
  }
}

TEST(Cover, WhenTheOwnRobotIsCovered_ThenNoPointOfItsSurfaceIsOutside) {
  const Robot robot = tests::two_arms();
  const auto bodies = read_bodies(robot, MeshLocator(tests::own_folder()));
  ASSERT_TRUE(bodies);
  const SphereModel model = cover(*bodies);
  expect_all_inside(*bodies, model, 1);
  EXPECT_LT(model.count(), 220u);
}

TEST(Cover, WhenMeshesOfOthersAreCovered_ThenNoPointOfTheirSurfaceIsOutside) {
  const auto panda = tests::data_of_others("arms/panda/panda.urdf");
  if (!panda) GTEST_SKIP() << "data/arms is not on this machine";
  const Robot robot = tests::robot_of(*panda);
  const auto bodies = read_bodies(robot, MeshLocator(panda->parent_path()));
  ASSERT_TRUE(bodies) << to_string(bodies.error());
  expect_all_inside(*bodies, cover(*bodies), 2);
}

// A body like a U: its hull is not its inside.
TriangleMesh u_shape() {
  // A prism of eight corners, along z.
  const std::vector<Vector3> ring{{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {2, 2, 0},
                                  {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  TriangleMesh mesh;
  for (const Vector3& p : ring) mesh.points.push_back(p);
  for (const Vector3& p : ring) mesh.points.push_back(p + Vector3{0, 0, 1});
  for (std::uint32_t k = 0; k < 8; ++k) {
    const std::uint32_t n = (k + 1) % 8;
    mesh.triangles.push_back({k, n, k + 8});
    mesh.triangles.push_back({n, n + 8, k + 8});
  }
  for (const auto& t : std::vector<std::array<std::uint32_t, 3>>{
           {0, 5, 7}, {5, 6, 7}, {0, 1, 5}, {1, 4, 5}, {1, 2, 4}, {2, 3, 4}}) {
    mesh.triangles.push_back({t[0], t[2], t[1]});
    mesh.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  }
  return mesh;
}

TEST(Cover, WhenABodyIsNotConvex_ThenItsInsideIsCoveredToo) {
  const TriangleMesh mesh = u_shape();
  Random random(3);
  for (const double protrusion : {0.5, 0.2}) {
    const auto spheres = cover(mesh, {.protrusion_m = protrusion, .most_per_body = 100});
    for (int k = 0; k < 20000; ++k) {
      const Vector3 p{random.between(0, 3), random.between(0, 2), random.between(0, 1)};
      if (p.x > 1 && p.x < 2 && p.y > 1) continue;
      ASSERT_TRUE(contains(spheres, p)) << protrusion;
    }
  }
}

TEST(Cover, WhenLessMayStandOut_ThenThereAreMoreSpheresAndTheyAreTighter) {
  const TriangleMesh box = box_mesh({0.1, 0.2, 0.4});
  std::size_t before = 0;
  double reach_before = 1e9;
  for (const double protrusion : {0.1, 0.05, 0.035, 0.025}) {
    const auto spheres = cover(box, {.protrusion_m = protrusion, .most_per_body = 500});
    double reach = 0.0;
    for (const Sphere& each : spheres) reach = std::max(reach, each.centre_m.x + each.radius_m - 0.05);
    EXPECT_GE(spheres.size(), before);
    EXPECT_LE(reach, protrusion * 1.05 + 1e-3);
    EXPECT_LE(reach, reach_before);
    before = spheres.size(), reach_before = reach;
  }
  EXPECT_LE(cover(box, {.protrusion_m = 1e-6, .most_per_body = 10}).size(), 10u);
  EXPECT_TRUE(cover(TriangleMesh{}, {}).empty());
}

}  // namespace
}  // namespace stepwright::motion
