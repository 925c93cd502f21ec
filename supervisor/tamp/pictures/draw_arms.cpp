#include "supervisor/tamp/pictures/draw_arms.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "supervisor/motion/kinematics/link_frames.h"
#include "supervisor/tamp/pictures/mesh_faces.h"
#include "supervisor/tamp/pictures/thing_stages.h"
#include "supervisor/tamp/schedule/arm_capsules.h"

namespace stepwright::tamp::pictures {
namespace {

using motion::Transform;
using motion::Vector3;

constexpr std::size_t kMostFaces = 160;  // of a mesh
constexpr double kLookEvery_s = 0.02;
constexpr double kWayPoint_m = 0.01;
constexpr double kTenth_mm = 1e-4;  // what terminals count in, m
constexpr double kAngle_rad = 1e-4;

PicturePoint point_of(Vector3 point) {
  return {point.x, point.y, point.z};
}

PictureSolid solid_of(const motion::Body& body) {
  const motion::Shape& shape = body.shape;
  PictureSolid solid{.place = drawn(shape.origin)};
  switch (shape.kind) {
    case motion::ShapeKind::Box:
      solid.size_m = point_of(shape.size_m);
      break;
    case motion::ShapeKind::Cylinder:
      solid.kind = PictureSolid::Kind::Cylinder;
      solid.radius_m = shape.radius_m;
      solid.length_m = shape.length_m;
      break;
    case motion::ShapeKind::Sphere:
      solid.kind = PictureSolid::Kind::Ball;
      solid.radius_m = shape.radius_m;
      break;
    case motion::ShapeKind::Mesh: {
      solid.kind = PictureSolid::Kind::Mesh;
      if (body.mesh == nullptr) break;
      const motion::TriangleMesh few = few_faces(*body.mesh, kMostFaces);
      for (const Vector3 point : few.points) solid.points.push_back(point_of(point));
      solid.triangles = few.triangles;
      break;
    }
  }
  return solid;
}

std::vector<PictureSolid> solid_of(const scene::Form& form, const scene::Pose& pose) {
  return {solid_of({scene::obstacle_of({}, form, pose).shape, nullptr})};
}

class ArmsPictureWriter {
 public:
  explicit ArmsPictureWriter(const ArmsPictureInput& input)
      : input_(input),
        cell_(*input.cell),
        start_(input.start != nullptr ? *input.start : scene::initial_state(*input.cell)),
        values_(scene::values_of(cell_, start_)) {}

  ArmsPicture write() {
    made_.id = "cell";
    made_.program = input_.digest;
    for (const scene::Furniture& each : cell_.furniture)
      made_.bodies.push_back({each.name, solid_of(each.form, each.pose)});
    for (const scene::Surface& each : cell_.surfaces)
      made_.surfaces.push_back(
          {each.name, drawn(scene::frame_of(each.middle)), each.size_x_m, each.size_y_m});
    for (std::size_t link = 0; link < cell_.robot.links.size(); ++link) add_frame(static_cast<int>(link));
    for (std::size_t arm = 0; arm < cell_.arms.size(); ++arm) add_arm(arm);
    add_things();
    if (input_.program != nullptr) add_variables(input_.program->variables);
    return std::move(made_);
  }

 private:
  // What tells a coordinate of the robot; half the way between fingers is half of their opening. The words of
  // terminals are whole numbers, which pages get as they are; of others they get three digits.
  PictureValue value_of(int coordinate, double multiplier, double offset) const {
    const double rest = values_[static_cast<std::size_t>(coordinate)];
    PictureValue value{.factor = multiplier, .offset = offset, .rest = rest};
    for (std::size_t arm = 0; arm < cell_.arms.size(); ++arm) {
      const scene::ArmModel& model = cell_.arms[arm];
      for (std::size_t k = 0; k < model.coordinates.size(); ++k)
        if (model.coordinates[k] == coordinate)
          value = counted(variables(arm).angles[k], kAngle_rad, multiplier, offset, rest);
      if (model.gripper == coordinate)
        value = counted(variables(arm).opening, kTenth_mm, 0.5 * multiplier, offset, 2.0 * rest);
    }
    if (value.variable.empty()) value.offset = multiplier * rest + offset;
    return value;
  }

  static PictureValue counted(const std::string& variable, double unit, double multiplier, double offset,
                              double rest) {
    return {.variable = variable, .factor = multiplier * unit, .offset = offset, .rest = rest / unit};
  }

  program::ArmVariables variables(std::size_t arm) const {
    if (input_.program != nullptr) return input_.program->variables.arms[arm];
    program::ArmVariables none;
    none.angles.resize(cell_.arms[arm].coordinates.size());
    return none;
  }

  int arm_of(int link) const {
    for (std::size_t arm = 0; arm < cell_.arms.size(); ++arm)
      if (cell_.robot.hangs_below(link, link_of(arm, 0))) return static_cast<int>(arm);
    return -1;
  }

  // That the joint moves.
  int link_of(std::size_t arm, std::size_t joint) const {
    const int coordinate = cell_.arms[arm].coordinates[joint];
    return motion::Robot::link_below(cell_.robot.coordinates[static_cast<std::size_t>(coordinate)].joint);
  }

  void add_frame(int link) {
    const auto number = static_cast<std::size_t>(link);
    ArmsPicture::Frame frame{
        .name = cell_.robot.links[number].name, .parent = cell_.robot.parent_link(link), .arm = arm_of(link)};
    if (link > 0) {
      const motion::Joint& joint =
          cell_.robot.joints[static_cast<std::size_t>(motion::Robot::joint_above(link))];
      frame.place = drawn(joint.origin);
      frame.axis = point_of(joint.axis);
      if (joint.coordinate >= 0) {
        frame.motion = joint.kind == motion::JointKind::Prismatic ? ArmsPicture::Motion::Slides
                                                                  : ArmsPicture::Motion::Turns;
        frame.value = value_of(joint.coordinate, joint.multiplier, joint.offset);
      }
    }
    for (const motion::Body& each : cell_.bodies[number]) frame.solids.push_back(solid_of(each));
    made_.frames.push_back(std::move(frame));
  }

  void add_arm(std::size_t number) {
    const scene::ArmModel& model = cell_.arms[number];
    const program::ArmVariables named = variables(number);
    ArmsPicture::Arm arm{.name = model.name, .tool = model.tip};
    for (std::size_t k = 0; k < model.coordinates.size(); ++k) {
      const int link = link_of(number, k);
      const int joint = motion::Robot::joint_above(link);
      arm.joints.push_back({cell_.robot.joints[static_cast<std::size_t>(joint)].name, link});
    }
    const double open_m = 2.0 * values_[static_cast<std::size_t>(model.gripper)];
    arm.opening = named.opening.empty() ? PictureValue{.offset = open_m}
                                        : counted(named.opening, kTenth_mm, 1.0, 0.0, open_m);
    arm.capsules = capsules(number);
    arm.waiting = named.waiting;
    arm.grasped = named.grasped;
    arm.standing = named.standing;
    arm.error = named.error;
    if (input_.schedule != nullptr) {
      arm.progress = named.progress;
      arm.held = held(number);
      add_steps(input_.schedule->arms[number], model, arm);
    }
    made_.arms.push_back(std::move(arm));
  }

  std::vector<ArmsPicture::Capsule> capsules(std::size_t arm) const {
    std::vector<ArmsPicture::Capsule> all;
    const schedule::ArmCapsules model = schedule::arm_capsules(cell_, arm);
    for (const schedule::Capsule& each : model.capsules) all.push_back(drawn_capsule(arm, model, each));
    return all;
  }

  // Those of the interlock are in frames of its own, whose axes are all z: where they are at 0 tells where
  // they are in the links.
  ArmsPicture::Capsule drawn_capsule(std::size_t arm, schedule::ArmCapsules model,
                                     const schedule::Capsule& capsule) const {
    const std::vector<double> zeros(cell_.robot.coordinates.size(), 0.0);
    std::vector<Transform> frames(cell_.robot.links.size());
    motion::LinkFrames(cell_.robot).place(zeros, frames);
    model.capsules = {capsule};
    const schedule::Capsule there =
        schedule::capsules_at(model, std::vector<double>(model.joints.size(), 0.0)).front();
    const int link = link_of(arm, static_cast<std::size_t>(capsule.joint - 1));
    const Transform back = inverse(frames[static_cast<std::size_t>(link)]);
    return {link, point_of(back * there.from), point_of(back * there.to), there.radius_m};
  }

  // From when the fingers close until they open.
  std::vector<ArmsPicture::Held> held(std::size_t arm) const {
    const schedule::ArmSchedule& planned = input_.schedule->arms[arm];
    const schedule::ArmCapsules model = schedule::arm_capsules(cell_, arm);
    const auto end = static_cast<double>(planned.steps.size()) + 1.0;
    std::vector<ArmsPicture::Held> all;
    if (planned.held) all.push_back({drawn_capsule(arm, model, *planned.held), 0.0, end});
    for (std::size_t k = 0; k < planned.steps.size(); ++k) {
      const schedule::ScheduledStep& step = planned.steps[k];
      if (step.held) all.push_back({drawn_capsule(arm, model, *step.held), static_cast<double>(k), end});
      if (step.kind == schedule::StepKind::Release && !all.empty()) all.back().until = static_cast<double>(k);
    }
    return all;
  }

  void add_steps(const schedule::ArmSchedule& planned, const scene::ArmModel& model,
                 ArmsPicture::Arm& arm) const {
    for (std::size_t k = 0; k < planned.steps.size(); ++k) {
      const schedule::ScheduledStep& from = planned.steps[k];
      ArmsPicture::Step step{.kind = schedule::name_of(from.kind)};
      if (from.thing >= 0) step.thing = cell_.things[static_cast<std::size_t>(from.thing)].name;
      for (const schedule::Wait& each : from.waits)
        step.waits.push_back({each.at, static_cast<int>(each.other), each.progress});
      arm.steps.push_back(std::move(step));
      if (from.motion) add_way(*from.motion, k, model, arm.way);
    }
  }

  static void add_way(const schedule::TimedMotion& motion, std::size_t step, const scene::ArmModel& model,
                      std::vector<ArmsPicture::WayPoint>& way) {
    const double duration_s = motion.duration_s();
    const auto looks = static_cast<std::size_t>(std::ceil(duration_s / kLookEvery_s));
    motion::Configuration joints(motion.path.joints());
    for (std::size_t k = 0; k <= looks; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(std::max<std::size_t>(looks, 1));
      motion.path.at(motion.law.at(share * duration_s).place, joints);
      const Vector3 at = (model.base * model.chain.forward(joints)).position_m;
      const bool is_end = k == 0 || k == looks;
      if (!is_end) {
        const auto& [x, y, z] = way.back().at_m;
        if (distance(at, {x, y, z}) < kWayPoint_m) continue;
      }
      way.push_back({point_of(at), static_cast<double>(step) + share});
    }
  }

  void add_things() {
    auto stages = thing_stages(cell_, start_, input_.schedule);
    for (std::size_t k = 0; k < cell_.things.size(); ++k)
      made_.things.push_back(
          {cell_.things[k].name, solid_of(cell_.things[k].form, {}), std::move(stages[k])});
  }

  void add_variables(const program::ArmsVariables& named) {
    if (cell_.arms.size() == 2) {
      made_.distance = named.distance;
      made_.least_distance_m = input_.program->min_distance_m;
    }
    made_.cause = named.cause;
    made_.cause_arm = named.cause_arm;
    for (int k = 0; k <= static_cast<int>(program::StopCause::Fingers); ++k)
      made_.causes.emplace_back(program::name_of(static_cast<program::StopCause>(k)));
    const program::CameraVariables& camera = named.camera;
    if (camera.reports.empty()) return;
    const auto place = [](const std::string& variable, double unit) {
      return PictureValue{.variable = variable, .factor = unit};
    };
    for (std::size_t s = 0; s < camera.kind.size(); ++s)
      made_.seen.push_back({camera.kind[s], place(camera.x[s], kTenth_mm), place(camera.y[s], kTenth_mm),
                            place(camera.z[s], kTenth_mm), place(camera.yaw[s], kAngle_rad)});
  }

  const ArmsPictureInput& input_;
  const scene::RobotCell& cell_;
  const scene::GeometricState start_;
  const std::vector<double> values_;  // of the robot's coordinates at the begin
  ArmsPicture made_;
};

}  // namespace

ArmsPicture arms_picture(const ArmsPictureInput& input) {
  return ArmsPictureWriter(input).write();
}

}  // namespace stepwright::tamp::pictures
