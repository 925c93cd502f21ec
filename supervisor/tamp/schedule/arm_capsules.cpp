#include "supervisor/tamp/schedule/arm_capsules.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "supervisor/tamp/scene/geometric_state.h"

namespace stepwright::tamp::schedule {

namespace {

using motion::Rotation;
using motion::Transform;
using motion::Vector3;

// A ball that a capsule has to contain: a point of a body's hull, or a sphere.
struct Ball {
  Vector3 at;
  double radius_m = 0.0;
};

// A body of the arm in the frame of a joint.
struct ArmBody {
  int joint = 1;
  int link = 0;
  motion::Body body;
  Transform place;  // of its frame: turned about the joint's z for an axial one
  Vector3 slide;    // how far it goes with the fingers
};

// The rotation that takes z to the axis, by the shortest way.
Rotation from_z_to(Vector3 axis) {
  const double c = axis.z;
  if (c < -1.0 + 1e-12) return {{1, 0, 0, 0, -1, 0, 0, 0, -1}};
  const Vector3 v{-axis.y, axis.x, 0.0};  // z cross axis
  const double k = 1.0 / (1.0 + c);
  return {{1.0 - k * v.y * v.y, k * v.x * v.y, v.y, k * v.x * v.y, 1.0 - k * v.x * v.x, -v.x, -v.y, v.x,
           1.0 - k * (v.x * v.x + v.y * v.y)}};
}

constexpr int kCorners = 48;  // of the polygon that stands for a circle

void add_circle(const Transform& frame, double height_m, double radius_m, std::vector<Ball>& balls) {
  const double around_m = radius_m / std::cos(std::numbers::pi / kCorners);
  for (int k = 0; k < kCorners; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kCorners;
    balls.push_back({frame * Vector3{around_m * std::cos(angle), around_m * std::sin(angle), height_m}});
  }
}

// Balls whose hull contains the body.
void add_balls(const motion::Body& body, const Transform& frame, std::vector<Ball>& balls) {
  const motion::Shape& shape = body.shape;
  switch (shape.kind) {
    case motion::ShapeKind::Sphere:
      balls.push_back({frame.position_m, shape.radius_m});
      break;
    case motion::ShapeKind::Cylinder:
      for (const double half : {-0.5, 0.5}) add_circle(frame, half * shape.length_m, shape.radius_m, balls);
      break;
    case motion::ShapeKind::Box:
      for (const double x : {-0.5, 0.5})
        for (const double y : {-0.5, 0.5})
          for (const double z : {-0.5, 0.5})
            balls.push_back({frame * Vector3{x * shape.size_m.x, y * shape.size_m.y, z * shape.size_m.z}});
      break;
    case motion::ShapeKind::Mesh:
      if (body.mesh != nullptr)
        for (const Vector3 point : body.mesh->points) balls.push_back({frame * point});
      break;
  }
}

struct Fit {
  double volume = std::numeric_limits<double>::infinity();
  Vector3 from, to;
  double radius_m = 0.0;
};

// The smallest capsule around a line of that radius that contains the balls.
void try_radius(const std::vector<Ball>& balls, Vector3 origin, Vector3 along, double radius_m, Fit& best) {
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const Ball& each : balls) {
    const Vector3 off = each.at - origin;
    const double place = dot(off, along);
    const double aside = length(motion::without(off, along));
    const double inner = radius_m - each.radius_m;
    if (inner < aside) return;
    const double reach = std::sqrt(inner * inner - aside * aside);
    first = std::min(first, place + reach);
    last = std::max(last, place - reach);
  }
  if (first > last) first = last = 0.5 * (first + last);
  const double volume = radius_m * radius_m * (last - first + 4.0 / 3.0 * radius_m);
  if (volume < best.volume) best = {volume, origin + first * along, origin + last * along, radius_m};
}

void try_line(const std::vector<Ball>& balls, Vector3 origin, Vector3 along, Fit& best) {
  double least = 0.0;
  for (const Ball& each : balls)
    least = std::max(least, length(motion::without(each.at - origin, along)) + each.radius_m);
  // A hair more, so that rounding leaves nothing out.
  for (int k = 0; k <= 40; ++k) try_radius(balls, origin, along, least * (1.0 + 0.02 * k) + 1e-9, best);
}

Vector3 middle_of(const std::vector<Ball>& balls) {
  Vector3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
  for (const Ball& each : balls) {
    const double r = each.radius_m;
    low = {std::min(low.x, each.at.x - r), std::min(low.y, each.at.y - r), std::min(low.z, each.at.z - r)};
    high = {std::max(high.x, each.at.x + r), std::max(high.y, each.at.y + r),
            std::max(high.z, each.at.z + r)};
  }
  return 0.5 * (low + high);
}

Capsule fitted(int joint, const std::vector<Ball>& balls, bool axial) {
  Fit best;
  if (axial) {
    try_line(balls, {}, {0, 0, 1}, best);
  } else {
    for (const Vector3 along : {Vector3{0, 0, 1}, Vector3{0, 1, 0}, Vector3{1, 0, 0}})
      try_line(balls, middle_of(balls), along, best);
  }
  return {joint, best.from, best.to, best.radius_m};
}

// A ball on the axis, or a cylinder along it: it looks the same however the joint turns.
bool is_axial(const motion::Shape& shape, const Transform& place) {
  constexpr double kNear = 1e-9;
  const bool on_axis = std::hypot(place.position_m.x, place.position_m.y) < kNear;
  if (shape.kind == motion::ShapeKind::Sphere) return on_axis;
  return shape.kind == motion::ShapeKind::Cylinder && on_axis &&
         std::abs(place.rotation.column(2).z) > 1.0 - kNear;
}

class Collector {
 public:
  Collector(const scene::RobotCell& cell, const scene::ArmModel& arm, const ArmCapsules& made,
            const std::vector<Rotation>& turns)
      : cell_(cell), made_(made), turns_(turns) {
    for (std::size_t k = 0; k < arm.coordinates.size(); ++k)
      moved_.push_back(motion::Robot::link_below(
          cell.robot.coordinates[static_cast<std::size_t>(arm.coordinates[k])].joint));
  }

  std::vector<Capsule> run() {
    for (std::size_t link = 0; link < cell_.robot.links.size(); ++link) collect(static_cast<int>(link));
    std::vector<Capsule> capsules;
    for (int joint = 1; joint <= 7; ++joint) add_joint(joint, capsules);
    return capsules;
  }

 private:
  // Of a link on the arm: the joint that carries it, its place there, and what the fingers do to it.
  void collect(int link) {
    Transform place;
    Vector3 slide;
    int at = link;
    while (true) {
      const auto carrier = std::find(moved_.begin(), moved_.end(), at);
      if (carrier != moved_.end()) {
        add(static_cast<int>(carrier - moved_.begin()) + 1, link, place, slide);
        return;
      }
      if (at == 0) return;
      const motion::Joint& joint = cell_.robot.joints[static_cast<std::size_t>(at - 1)];
      Transform step = joint.origin;
      slide = joint.origin.rotation * slide;
      if (joint.kind == motion::JointKind::Prismatic) {
        const motion::Coordinate& c = cell_.robot.coordinates[static_cast<std::size_t>(joint.coordinate)];
        const double low = joint.multiplier * c.lower + joint.offset;
        const double high = joint.multiplier * c.upper + joint.offset;
        step.position_m += joint.origin.rotation * (low * joint.axis);
        slide += joint.origin.rotation * ((high - low) * joint.axis);
      }
      place = step * place;
      at = joint.parent;
    }
  }

  void add(int joint, int link, const Transform& in_chain, Vector3 slide) {
    const Transform turn{transposed(turns_[static_cast<std::size_t>(joint - 1)]), {}};
    for (const motion::Body& body : cell_.bodies[static_cast<std::size_t>(link)]) {
      ArmBody one{joint, link, body, turn * in_chain * body.shape.origin, turn.rotation * slide};
      // Up to the next joint, if turning it changes nothing.
      while (one.joint < 7 && one.slide == Vector3{}) {
        const Transform next = inverse(made_.joints[static_cast<std::size_t>(one.joint)]) * one.place;
        if (!is_axial(body.shape, next)) break;
        one.place = next;
        ++one.joint;
      }
      bodies_.push_back(std::move(one));
    }
  }

  static void add_balls_of(const ArmBody& body, std::vector<Ball>& balls) {
    const std::size_t first = balls.size();
    add_balls(body.body, body.place, balls);
    if (body.slide == Vector3{}) return;
    const std::size_t count = balls.size();
    for (std::size_t k = first; k < count; ++k)
      balls.push_back({balls[k].at + body.slide, balls[k].radius_m});
  }

  // One around all that is axial, one around each link's other bodies.
  void add_joint(int joint, std::vector<Capsule>& capsules) const {
    std::vector<Ball> axial;
    for (const ArmBody& each : bodies_)
      if (each.joint == joint && each.slide == Vector3{} && is_axial(each.body.shape, each.place))
        add_balls_of(each, axial);
    if (!axial.empty()) capsules.push_back(fitted(joint, axial, true));
    for (std::size_t link = 0; link < cell_.robot.links.size(); ++link) {
      std::vector<Ball> balls;
      for (const ArmBody& each : bodies_)
        if (each.joint == joint && each.link == static_cast<int>(link) &&
            !(each.slide == Vector3{} && is_axial(each.body.shape, each.place)))
          add_balls_of(each, balls);
      if (!balls.empty()) capsules.push_back(fitted(joint, balls, false));
    }
  }

  const scene::RobotCell& cell_;
  const ArmCapsules& made_;
  const std::vector<Rotation>& turns_;
  std::vector<int> moved_;  // the link of each joint
  std::vector<ArmBody> bodies_;
};

std::vector<Rotation> turns_of(const scene::ArmModel& arm) {
  std::vector<Rotation> turns;
  for (const motion::ChainJoint& joint : arm.chain.joints()) turns.push_back(from_z_to(joint.axis));
  return turns;
}

double clamped(double value) {
  return std::clamp(value, -1.0, 1.0);
}

}  // namespace

ArmCapsules arm_capsules(const scene::RobotCell& cell, std::size_t arm) {
  const scene::ArmModel& model = cell.arms[arm];
  const std::vector<Rotation> turns = turns_of(model);
  ArmCapsules made;
  Transform before = model.base;
  for (std::size_t k = 0; k < made.joints.size(); ++k) {
    made.joints[k] = before * model.chain.joints()[k].before * Transform{turns[k], {}};
    before = {transposed(turns[k]), {}};
  }
  made.capsules = Collector(cell, model, made, turns).run();
  return made;
}

Capsule held_capsule(const scene::RobotCell& cell, std::size_t arm, std::size_t thing, double hand_rad) {
  const scene::ArmModel& model = cell.arms[arm];
  const Transform last{transposed(turns_of(model).back()), {}};
  const Transform tool = scene::tool_pose(0.0, 0.0, cell.tool_above(static_cast<int>(thing)), hand_rad);
  const Transform place = last * model.chain.tool() * inverse(tool);
  const motion::Obstacle body = scene::obstacle_of(cell.things[thing].name, cell.things[thing].form, {});
  std::vector<Ball> balls;
  add_balls({body.shape, body.mesh}, body.shape.origin, balls);
  Fit best;
  try_line(balls, middle_of(balls), {0, 0, 1}, best);
  return {7, place * best.from, place * best.to, best.radius_m};
}

std::vector<Capsule> capsules_at(const ArmCapsules& arm, std::span<const double> joints) {
  std::vector<Capsule> all;
  all.reserve(arm.capsules.size());
  Transform at;
  std::size_t next = 0;
  for (std::size_t k = 0; k < arm.joints.size(); ++k) {
    const double c = std::cos(joints[k]), s = std::sin(joints[k]);
    at = at * arm.joints[k] * Transform{Rotation{{c, -s, 0, s, c, 0, 0, 0, 1}}, {}};
    for (; next < arm.capsules.size() && arm.capsules[next].joint == static_cast<int>(k) + 1; ++next) {
      const Capsule& each = arm.capsules[next];
      all.push_back({each.joint, at * each.from, at * each.to, each.radius_m});
    }
  }
  return all;
}

ArmCapsules with_held(ArmCapsules empty, const scene::RobotCell& cell, const scene::GeometricState& state,
                      std::size_t arm) {
  const int thing = state.arms[arm].holds;
  if (thing < 0) return empty;
  const auto held = static_cast<std::size_t>(thing);
  empty.capsules.push_back(held_capsule(cell, arm, held, state.things[held].hand_rad));
  return empty;
}

std::vector<Capsule> others_at(std::span<const ArmCapsules> empty, const scene::RobotCell& cell,
                               const scene::GeometricState& state, std::size_t arm) {
  std::vector<Capsule> all;
  for (std::size_t other = 0; other < empty.size(); ++other) {
    if (other == arm) continue;
    const std::vector<Capsule> there =
        capsules_at(with_held(empty[other], cell, state, other), state.arms[other].at);
    all.insert(all.end(), there.begin(), there.end());
  }
  return all;
}

double distance_of(const Capsule& a, const Capsule& b) {
  // Each line as its middle and half of its way, places on it from -1 to 1.
  const Vector3 da = 0.5 * (a.to - a.from), db = 0.5 * (b.to - b.from);
  const Vector3 between = 0.5 * (a.from + a.to) - 0.5 * (b.from + b.to);
  const double aa = dot(da, da), bb = dot(db, db), ab = dot(da, db);
  const double ac = dot(da, between), bc = dot(db, between);
  const double flat = aa * bb - ab * ab;
  double s = flat > 1e-12 * aa * bb ? clamped((ab * bc - ac * bb) / flat) : 0.0;
  double t = bb > 0.0 ? (ab * s + bc) / bb : 0.0;
  if (t < -1.0 || t > 1.0 || bb == 0.0) {
    t = clamped(t);
    s = aa > 0.0 ? clamped((ab * t - ac) / aa) : 0.0;
  }
  return length(between + s * da - t * db) - a.radius_m - b.radius_m;
}

double distance_of(std::span<const Capsule> a, std::span<const Capsule> b) {
  double least = std::numeric_limits<double>::infinity();
  for (const Capsule& one : a)
    for (const Capsule& other : b) least = std::min(least, distance_of(one, other));
  return least;
}

}  // namespace stepwright::tamp::schedule
