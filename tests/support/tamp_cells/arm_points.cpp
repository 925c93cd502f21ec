#include "tests/support/tamp_cells/arm_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "supervisor/motion/kinematics/link_frames.h"

namespace stepwright::tamp::test {
namespace {

using motion::Vector3;

// In the frame of its link; as a rule of the body's surface.
Vector3 point_of(const motion::Shape& shape, motion::Random& random) {
  const double angle = random.between(0.0, 2.0 * std::numbers::pi);
  Vector3 at;
  if (shape.kind == motion::ShapeKind::Box) {
    at = {random.between(-0.5, 0.5) * shape.size_m.x, random.between(-0.5, 0.5) * shape.size_m.y,
          std::copysign(0.5, random.between(-1.0, 1.0)) * shape.size_m.z};
    if (random.between(0.0, 1.0) < 0.5) at.x = std::copysign(0.5 * shape.size_m.x, at.x);
    if (random.between(0.0, 1.0) < 0.5) at.y = std::copysign(0.5 * shape.size_m.y, at.y);
  } else if (shape.kind == motion::ShapeKind::Cylinder) {
    at = {shape.radius_m * std::cos(angle), shape.radius_m * std::sin(angle),
          random.between(-0.5, 0.5) * shape.length_m};
    if (random.between(0.0, 1.0) < 0.5) at.z = std::copysign(0.5 * shape.length_m, at.z);
  } else {
    const double z = random.between(-1.0, 1.0), aside = std::sqrt(1.0 - z * z);
    at = shape.radius_m * Vector3{aside * std::cos(angle), aside * std::sin(angle), z};
  }
  return shape.origin * at;
}

double outside(const std::vector<schedule::Capsule>& capsules, Vector3 point) {
  double nearest = 1e9;
  for (const schedule::Capsule& each : capsules)
    nearest = std::min(nearest, distance_of(each, {1, point, point, 0.0}));
  return nearest;
}

}  // namespace

double farthest_outside(const scene::RobotCell& cell, std::size_t arm, const schedule::ArmCapsules& model,
                        motion::Random& random, const PointsToDraw& draw) {
  const std::vector<int>& coordinates = cell.arms[arm].coordinates;
  const int first =
      motion::Robot::link_below(cell.robot.coordinates[static_cast<std::size_t>(coordinates.front())].joint);
  std::vector<motion::Transform> frames(cell.robot.links.size());
  double worst = -1e9;
  for (int place = 0; place < draw.places; ++place) {
    std::vector<double> values, joints;
    for (const motion::Coordinate& each : cell.robot.coordinates)
      values.push_back(random.between(each.lower, each.upper));
    for (const int each : coordinates) joints.push_back(values[static_cast<std::size_t>(each)]);
    motion::LinkFrames(cell.robot).place(values, frames);
    const std::vector<schedule::Capsule> capsules = capsules_at(model, joints);
    for (std::size_t link = 0; link < frames.size(); ++link) {
      if (!cell.robot.hangs_below(static_cast<int>(link), first)) continue;
      for (const motion::Shape& shape : cell.robot.links[link].shapes)
        for (int k = 0; k < draw.points; ++k)
          worst = std::max(worst, outside(capsules, frames[link] * point_of(shape, random)));
    }
  }
  return worst;
}

}  // namespace stepwright::tamp::test
