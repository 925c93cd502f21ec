#include "supervisor/tamp/scene/hand_parts.h"

#include <cmath>

#include "supervisor/motion/kinematics/link_frames.h"

namespace stepwright::tamp::scene {

namespace {

HandPart part_of(const motion::Shape& shape, const motion::Transform& at) {
  constexpr double kStraight = 1e-6;
  HandPart part;
  part.x_m = at.position_m.x;
  part.y_m = at.position_m.y;
  const motion::Vector3 axis = at.rotation.column(2);
  const bool along = std::abs(std::abs(axis.z) - 1.0) < kStraight;
  double half_z = 0.0;
  if (shape.kind == motion::ShapeKind::Box && along) {
    const motion::Vector3 x = at.rotation.column(0);
    part.turn_rad = std::atan2(x.y, x.x);
    part.half_x_m = 0.5 * shape.size_m.x;
    part.half_y_m = 0.5 * shape.size_m.y;
    half_z = 0.5 * shape.size_m.z;
  } else if (shape.kind == motion::ShapeKind::Cylinder && along) {
    part.round = true;
    part.radius_m = shape.radius_m;
    half_z = 0.5 * shape.length_m;
  } else {
    part.round = true;
    half_z = shape.kind == motion::ShapeKind::Box        ? 0.5 * length(shape.size_m)
             : shape.kind == motion::ShapeKind::Cylinder ? std::hypot(shape.radius_m, 0.5 * shape.length_m)
                                                         : shape.radius_m;
    part.radius_m = half_z;
  }
  part.from_m = at.position_m.z - half_z;
  part.to_m = at.position_m.z + half_z;
  return part;
}

}  // namespace

std::vector<HandPart> hand_parts(const motion::Robot& robot, int carrier, int tip,
                                 const std::vector<double>& rest) {
  std::vector<motion::Transform> frames(robot.links.size());
  motion::LinkFrames(robot).place(rest, frames);
  const motion::Transform back = inverse(frames[static_cast<std::size_t>(tip)]);
  std::vector<HandPart> parts;
  for (std::size_t link = 0; link < robot.links.size(); ++link)
    if (robot.hangs_below(static_cast<int>(link), carrier))
      for (const motion::Shape& shape : robot.links[link].shapes)
        parts.push_back(part_of(shape, back * frames[link] * shape.origin));
  return parts;
}

Upright placed(const HandPart& part, double x_m, double y_m, double z_m, double angle_rad, double sweep_m) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  Upright body;
  body.round = part.round;
  body.x_m = x_m + c * part.x_m + s * part.y_m;  // seen from above the hand's y axis is mirrored
  body.y_m = y_m + s * part.x_m - c * part.y_m;
  body.heading_rad = angle_rad - part.turn_rad;
  body.radius_m = part.radius_m;
  body.half_x_m = part.half_x_m;
  body.half_y_m = part.half_y_m;
  body.low_m = z_m - part.to_m;
  body.high_m = z_m - part.from_m + sweep_m;
  return body;
}

}  // namespace stepwright::tamp::scene
