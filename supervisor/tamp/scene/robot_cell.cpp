#include "supervisor/tamp/scene/robot_cell.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "supervisor/motion/kinematics/link_frames.h"

namespace stepwright::tamp::scene {

namespace {

template <typename T>
int place_of(const std::vector<T>& all, std::string_view named) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const T& each) { return each.name == named; });
  return found == all.end() ? -1 : static_cast<int>(found - all.begin());
}

result::Result<void> wrong(const result::Location& where, std::string message, std::string hint = {}) {
  return result::fail("G0103", where, std::move(message), std::move(hint));
}

// Around a thing: as wide as it is when it is closed, and open.
std::vector<HandPart> hand_around(const RobotCell& cell, const ArmModel& arm, int thing) {
  std::vector<double> rest = cell.rest;
  std::vector<HandPart> all;
  for (const double half_m : {cell.grip_m(thing), cell.open_m(thing)}) {
    rest[static_cast<std::size_t>(arm.gripper)] = half_m;
    const std::vector<HandPart> parts = hand_parts(cell.robot, arm.carrier, arm.tip, rest);
    all.insert(all.end(), parts.begin(), parts.end());
  }
  return all;
}

bool same_bodies(const motion::Link& a, const motion::Link& b) {
  return std::equal(a.shapes.begin(), a.shapes.end(), b.shapes.begin(), b.shapes.end(),
                    [](const motion::Shape& one, const motion::Shape& other) {
                      return one.kind == other.kind && one.origin == other.origin &&
                             one.size_m == other.size_m && one.radius_m == other.radius_m &&
                             one.length_m == other.length_m && one.mesh == other.mesh &&
                             one.scale == other.scale;
                    });
}

motion::LinkSpheres spheres_around(const Thing& thing) {
  motion::CoverOptions options;
  options.protrusion_m = 0.015;
  return motion::cover({{{obstacle_of(thing.name, thing.form, {}).shape, nullptr}}}, options).links.front();
}

}  // namespace

int RobotCell::arm(std::string_view named) const {
  return place_of(arms, named);
}
int RobotCell::surface(std::string_view named) const {
  return place_of(surfaces, named);
}
int RobotCell::thing(std::string_view named) const {
  return place_of(things, named);
}

result::Result<void> add_arms(RobotCell& cell, const std::vector<ArmNames>& names,
                              const result::Location& where) {
  cell.rest.assign(cell.robot.coordinates.size(), 0.0);
  for (const motion::NamedState& state : cell.semantics.states)
    if (state.name == "home")
      for (const auto& [coordinate, value] : state.values)
        cell.rest[static_cast<std::size_t>(coordinate)] = value;
  for (const ArmNames& each : names) {
    const motion::Group* const group = cell.semantics.group(each.group);
    if (group == nullptr || group->tip_link < 0)
      return wrong(where, "'" + each.group + "' is no group of one chain",
                   "a <group> with a <chain> in the SRDF");
    auto chain = motion::Chain::between(cell.robot, group->base_link, group->tip_link);
    if (!chain) return result::forward(chain);
    auto kinematics = motion::SrsArm::recognise(*chain);
    if (!kinematics)
      return wrong(where, "arm '" + each.name + "' has no inverse kinematics in closed form",
                   "seven joints: a spherical shoulder, an elbow, a spherical wrist");
    const int gripper = cell.robot.coordinate(each.gripper);
    if (gripper < 0) return wrong(where, "the robot has no joint '" + each.gripper + "'");
    std::vector<int> coordinates;
    for (const motion::ChainJoint& joint : chain->joints()) coordinates.push_back(joint.coordinate);
    ArmModel arm{each.name, *chain, *kinematics, std::move(coordinates), group->tip_link, 0, gripper,
                 {},        {},     {}};
    arm.carrier = motion::Robot::link_below(
        cell.robot.coordinates[static_cast<std::size_t>(arm.coordinates.back())].joint);
    for (std::size_t k = 0; k < arm.home.size(); ++k)
      arm.home[k] = cell.rest[static_cast<std::size_t>(arm.coordinates[k])];
    std::vector<motion::Transform> frames(cell.robot.links.size());
    motion::LinkFrames(cell.robot).place(cell.rest, frames);
    arm.base = frames[static_cast<std::size_t>(group->base_link)];
    const double widest_m = cell.robot.coordinates[static_cast<std::size_t>(gripper)].upper;
    for (std::size_t k = 0; k < cell.things.size(); ++k) {
      const int thing = static_cast<int>(k);
      if (!cell.things[k].form.round || cell.open_m(thing) > widest_m)
        return wrong(
            where, "the fingers of '" + each.name + "' do not go around '" + cell.things[k].name + "'",
            "cylinders are grasped from above; they open to " + std::to_string(2.0 * widest_m) + " m");
      arm.hand_of.push_back(hand_around(cell, arm, thing));
    }
    cell.arms.push_back(std::move(arm));
  }
  return {};
}

void add_spheres(RobotCell& cell) {
  // Arms work close to their own torso: spheres that stand out further would forbid most of that.
  motion::CoverOptions options;
  options.protrusion_m = 0.012;
  options.most_per_body = 128;
  for (std::size_t k = 0; k < cell.bodies.size(); ++k) {
    // The other arm has the same bodies.
    std::size_t same = 0;
    while (same < k && !same_bodies(cell.robot.links[same], cell.robot.links[k])) ++same;
    cell.spheres.links.push_back(same < k ? cell.spheres.links[same]
                                          : motion::cover({cell.bodies[k]}, options).links.front());
  }
  for (const Thing& each : cell.things) cell.thing_spheres.push_back(spheres_around(each));
}

motion::Transform tool_pose(double x_m, double y_m, double z_m, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return {motion::from_columns({c, s, 0.0}, {s, -c, 0.0}, {0.0, 0.0, -1.0}), {x_m, y_m, z_m}};
}

motion::Transform frame_of(const Pose& pose) {
  return {motion::about({0, 0, 1}, pose.angle_rad), {pose.x_m, pose.y_m, pose.z_m}};
}

motion::Obstacle obstacle_of(const std::string& name, const Form& form, const Pose& pose, double shrunk_m) {
  motion::Transform at = frame_of(pose);
  at.position_m.z += 0.5 * form.height_m;
  const double height_m = form.height_m - 2.0 * shrunk_m;
  if (form.round) return motion::cylinder(name, at, form.radius_m - shrunk_m, height_m);
  return motion::box(name, at, {form.size_x_m - 2.0 * shrunk_m, form.size_y_m - 2.0 * shrunk_m, height_m});
}

motion::AttachedBody held_thing(const RobotCell& cell, std::size_t thing, const ArmModel& arm,
                                const motion::Transform& place, double shrunk_m) {
  const Thing& held = cell.things[thing];
  return motion::moved({held.name,
                        0,
                        {{obstacle_of(held.name, held.form, {}, shrunk_m).shape, nullptr}},
                        cell.thing_spheres[thing].spheres,
                        {},
                        cell.thing_spheres[thing].bound},
                       arm.tip, place);
}

Pose top_of(const RobotCell& cell, int carrier, const Pose& stands, double angle_rad) {
  return {stands.x_m, stands.y_m, stands.z_m + cell.things[static_cast<std::size_t>(carrier)].form.height_m,
          angle_rad};
}

bool stands_on(const Form& upper, const Pose& above, const Form& lower, const Pose& below) {
  return std::abs(above.z_m - below.z_m - lower.height_m) <= kTouch_m &&
         gap(standing(upper, above), standing(lower, below)) < 0.0;
}

bool fits_on(const Form& upper, const Form& lower) {
  constexpr double kRounded_m = 1e-9;
  if (lower.round) return radius_around(upper) <= lower.radius_m + kRounded_m;
  return radius_around(upper) <= 0.5 * std::min(lower.size_x_m, lower.size_y_m) + kRounded_m;
}

bool lies_within(const Surface& surface, const Form& form, const Pose& pose, double slack_m) {
  const double c = std::cos(surface.middle.angle_rad), s = std::sin(surface.middle.angle_rad);
  const double dx = pose.x_m - surface.middle.x_m, dy = pose.y_m - surface.middle.y_m;
  const double around_m = radius_around(form) - slack_m;
  return std::abs(c * dx + s * dy) <= 0.5 * surface.size_x_m - around_m &&
         std::abs(c * dy - s * dx) <= 0.5 * surface.size_y_m - around_m;
}

}  // namespace stepwright::tamp::scene
