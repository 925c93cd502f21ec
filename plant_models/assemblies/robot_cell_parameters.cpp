#include "plant_models/assemblies/robot_cell_parameters.h"

#include <algorithm>
#include <set>

#include "plant_models/assemblies/requirements.h"

namespace stepwright::assemblies {
namespace {

constexpr double kFarthest_m = 3.2;  // counts of 0.1 mm in 16 bits
constexpr double kMostTurn_rad = 3.2;
constexpr double kUnit = 1e-6;  // how far an axis may be from length 1

bool is_near_one(Vec3 axis) {
  return std::abs(length(axis) - 1.0) < kUnit;
}

bool is_within(Vec3 place) {
  return std::abs(place.x) <= kFarthest_m && std::abs(place.y) <= kFarthest_m &&
         std::abs(place.z) <= kFarthest_m;
}

void check_arm(const ArmFigures& arm, Requirements& wanted) {
  for (std::size_t k = 0; k < kArmJoints; ++k) {
    const JointFigures& joint = arm.joints[k];
    const std::string name = arm.name + ": joint " + std::to_string(k + 1);
    wanted.require(is_near_one(joint.axis) && is_within(joint.before.place), name + " has no place and axis");
    wanted.require(joint.lower_rad < joint.upper_rad && joint.lower_rad >= -kMostTurn_rad &&
                       joint.upper_rad <= kMostTurn_rad,
                   name + " must turn within +-3.2 rad");
    wanted.positive(joint.velocity_rad_s, name + ": velocity");
    wanted.require(arm.start_rad[k] >= joint.lower_rad && arm.start_rad[k] <= joint.upper_rad,
                   name + " starts beyond its limits");
  }
  wanted.positive(arm.most_opening_m, arm.name + ": opening");
  for (const ArmBody& body : arm.bodies)
    wanted.require(body.joint < kArmJoints, arm.name + ": a body hangs on no joint");
}

void check_drive(const DriveFigures& drive, Requirements& wanted) {
  wanted.positive(drive.position_gain_1_s, "drive: position_gain_1_s");
  wanted.positive(drive.time_constant_s, "drive: time_constant_s");
  wanted.positive(drive.brake_rad_s2, "drive: brake_rad_s2");
  wanted.positive(drive.following_rad, "drive: following_rad");
  for (std::size_t k = 0; k < kArmJoints; ++k) {
    wanted.positive(drive.acceleration_rad_s2[k], "drive: acceleration_rad_s2");
    wanted.positive(drive.inertia_kgm2[k], "drive: inertia_kgm2");
  }
}

void check_hand(const HandFigures& hand, Requirements& wanted) {
  wanted.positive(hand.speed_m_s, "hand: speed_m_s");
  wanted.positive(hand.gain_1_s, "hand: gain_1_s");
  wanted.positive(hand.force_n, "hand: force_n");
  wanted.positive(hand.stiffness_n_m, "hand: stiffness_n_m");
  wanted.positive(hand.friction, "hand: friction");
  wanted.positive(hand.slide_out_m, "hand: slide_out_m");
}

void check_camera(const CameraFigures& camera, Requirements& wanted) {
  wanted.not_negative(camera.delay_s, "camera: delay_s");
  wanted.require(camera.loss >= 0.0 && camera.loss <= 1.0, "camera: loss must lie in 0..1");
  wanted.require(camera.ghosts >= 0.0 && camera.ghosts <= 1.0, "camera: ghosts must lie in 0..1");
  wanted.not_negative(camera.position_m, "camera: position_m");
  wanted.not_negative(camera.yaw_rad, "camera: yaw_rad");
  wanted.require(camera.view_low_x_m <= camera.view_high_x_m && camera.view_low_y_m <= camera.view_high_y_m,
                 "camera: the view has its corners exchanged");
}

void check_objects(const RobotCellParameters& p, Requirements& wanted) {
  std::set<std::string> names;
  for (const ObjectFigures& object : p.objects) {
    const bool fits = !object.name.empty() && object.name.size() <= 40;
    wanted.require(fits && names.insert(object.name).second,
                   "object '" + object.name + "' needs a name of its own, of at most 40 letters");
    wanted.require(is_within({object.x_m, object.y_m, 0.0}) && std::isfinite(object.yaw_rad),
                   object.name + " stands more than 3.2 m from the origin");
    wanted.not_negative(object.mass_kg, object.name + ": mass_kg");
    for (const double side : {object.size_m.x, object.size_m.y, object.size_m.z})
      wanted.require(side >= 0.0 && side <= 1.0, object.name + ": sides must lie in 0..1 m");
  }
}

}  // namespace

void make_certain(RobotCellParameters& parameters) {
  parameters.camera.loss = parameters.camera.ghosts = 0.0;
  parameters.camera.position_m = parameters.camera.yaw_rad = 0.0;
  parameters.encoder.noise_rad = 0.0;
}

std::size_t camera_slots(const RobotCellParameters& parameters) {
  return parameters.camera.slots > 0 ? parameters.camera.slots
                                     : parameters.objects.size() + parameters.blockages.size() + 2;
}

result::Result<void> validate(const RobotCellParameters& p) {
  Requirements wanted;
  wanted.require(!p.arms.empty() && p.arms.size() <= kMostArms, "a robot cell has one or two arms");
  for (const ArmFigures& arm : p.arms) check_arm(arm, wanted);
  if (p.arms.size() == 2)
    wanted.require(p.arms[0].name != p.arms[1].name, "both arms have the name '" + p.arms[0].name + "'");
  check_drive(p.drive, wanted);
  check_hand(p.hand, wanted);
  check_camera(p.camera, wanted);
  wanted.not_negative(p.encoder.noise_rad, "encoder: noise_rad");
  wanted.positive(p.encoder.resolution_rad, "encoder: resolution_rad");
  wanted.require(p.objects.size() <= kMostCellObjects, "a robot cell has at most 16 objects");
  wanted.require(p.blockages.size() <= kMostCellBlockages, "a robot cell has at most 4 blockages");
  wanted.require(camera_slots(p) <= kMostCameraSlots, "a camera has at most 24 slots");
  check_objects(p, wanted);
  return wanted.finish();
}

}  // namespace stepwright::assemblies
