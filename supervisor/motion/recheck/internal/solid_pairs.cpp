#include "supervisor/motion/recheck/internal/solid_pairs.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cmath>

namespace stepwright::motion::internal {

namespace {

fcl::Transform3d to_fcl(const Transform& at) {
  fcl::Transform3d out = fcl::Transform3d::Identity();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      out.linear()(row, column) =
          at.rotation(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
  out.translation() = fcl::Vector3d(at.position_m.x, at.position_m.y, at.position_m.z);
  return out;
}

std::shared_ptr<fcl::CollisionGeometryd> geometry_of(const Body& body) {
  const Shape& shape = body.shape;
  switch (shape.kind) {
    case ShapeKind::Box:
      return std::make_shared<fcl::Boxd>(shape.size_m.x, shape.size_m.y, shape.size_m.z);
    case ShapeKind::Cylinder:
      return std::make_shared<fcl::Cylinderd>(shape.radius_m, shape.length_m);
    case ShapeKind::Sphere:
      return std::make_shared<fcl::Sphered>(shape.radius_m);
    case ShapeKind::Mesh:
      break;
  }
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  std::vector<fcl::Vector3d> points;
  std::vector<fcl::Triangle> triangles;
  for (const Vector3& each : body.mesh->points) points.emplace_back(each.x, each.y, each.z);
  for (const auto& each : body.mesh->triangles) triangles.emplace_back(each[0], each[1], each[2]);
  model->beginModel();
  model->addSubModel(points, triangles);
  model->endModel();
  return model;
}

Sphere sphere_around(const Body& body) {
  const Shape& shape = body.shape;
  switch (shape.kind) {
    case ShapeKind::Box:
      return {shape.origin.position_m, 0.5 * length(shape.size_m)};
    case ShapeKind::Cylinder:
      return {shape.origin.position_m, std::hypot(shape.radius_m, 0.5 * shape.length_m)};
    case ShapeKind::Sphere:
      return {shape.origin.position_m, shape.radius_m};
    case ShapeKind::Mesh:
      break;
  }
  Sphere around = enclosing_sphere(body.mesh->points);
  around.centre_m = shape.origin * around.centre_m;
  return around;
}

}  // namespace

class SolidGeometry {
 public:
  explicit SolidGeometry(const Body& body) : fcl_(geometry_of(body)) { fcl_->computeLocalAABB(); }
  const fcl::CollisionGeometryd* get() const { return fcl_.get(); }

 private:
  std::shared_ptr<fcl::CollisionGeometryd> fcl_;
};

ExactSolid::ExactSolid(const Body& body)
    : geometry_(std::make_shared<SolidGeometry>(body)),
      mesh_(body.mesh),
      place_(body.shape.origin),
      around_(sphere_around(body)) {
  if (!mesh_ || mesh_->points.empty()) return;
  point_m_ = low_m_ = high_m_ = mesh_->points.front();
  for (const Vector3& each : mesh_->points) {
    low_m_ = {std::min(low_m_.x, each.x), std::min(low_m_.y, each.y), std::min(low_m_.z, each.z)};
    high_m_ = {std::max(high_m_.x, each.x), std::max(high_m_.y, each.y), std::max(high_m_.z, each.z)};
  }
}

bool ExactSolid::holds(Vector3 point) const {
  // The box first: the number takes a look at every triangle.
  return mesh_ && point.x >= low_m_.x && point.x <= high_m_.x && point.y >= low_m_.y &&
         point.y <= high_m_.y && point.z >= low_m_.z && point.z <= high_m_.z &&
         std::abs(winding_number(*mesh_, point)) > 0.5;
}

bool meet(const ExactSolid& a, const Transform& at_a, const ExactSolid& b, const Transform& at_b) {
  const fcl::CollisionRequestd request(1, false);
  fcl::CollisionResultd result;
  fcl::collide(a.geometry_->get(), to_fcl(at_a), b.geometry_->get(), to_fcl(at_b), request, result);
  if (result.isCollision()) return true;
  return (a.mesh_ && a.holds(inverse(at_a) * (at_b * b.point_m_))) ||
         (b.mesh_ && b.holds(inverse(at_b) * (at_a * a.point_m_)));
}

double distance_below(const ExactSolid& a, const Transform& at_a, const ExactSolid& b,
                      const Transform& at_b) {
  if (meet(a, at_a, b, at_b)) return 0.0;
  const fcl::DistanceRequestd request(false);
  fcl::DistanceResultd result;
  fcl::distance(a.geometry_->get(), to_fcl(at_a), b.geometry_->get(), to_fcl(at_b), request, result);
  constexpr double kIterated_m = 1e-5;  // the distance is found by iteration, to 1e-6
  return std::max(0.0, result.min_distance - kIterated_m);
}

}  // namespace stepwright::motion::internal
