#pragma once

// The figures of a robot cell: arms of seven joints as plain numbers, hands of two fingers, what stands
// fixed, objects, a camera. m, kg, rad, s. Where the numbers of a robot come from is not this folder's
// business: the cell reads them from URDF (cell/robot). plant_models/doc/robot_cell.md has the model.
//
// Aggregates with safe defaults; validate() judges them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "plant_models/assemblies/robot_cell_solids.h"
#include "plant_models/assemblies/robot_cell_space.h"
#include "runtime/ground/result/result.h"

namespace stepwright::assemblies {

inline constexpr std::size_t kArmJoints = 7;
inline constexpr std::size_t kMostArms = 2;
inline constexpr std::size_t kMostCellObjects = 16;
inline constexpr std::size_t kMostCellBlockages = 4;
inline constexpr std::size_t kMostCameraSlots = 24;

using JointFigures7 = std::array<double, kArmJoints>;

struct JointFigures {
  Frame before;        // from the frame of the joint before, of the cell for the first one, at 0 rad
  Vec3 axis{0, 0, 1};  // of length 1
  double lower_rad = -1.0;
  double upper_rad = 1.0;
  double velocity_rad_s = 2.0;
};

// A solid that hangs on a joint. A finger goes along `slide` by half of the hand's opening.
struct ArmBody {
  std::size_t joint = 0;  // 0 to 6; it turns with it
  ConvexSolid solid;
  Frame frame;  // in the joint's frame
  Vec3 slide;
};

struct ArmFigures {
  std::string name;  // "left"
  std::array<JointFigures, kArmJoints> joints{};
  Frame tool;  // the point between the finger pads in the last joint's frame: z away from the hand, y to a
               // finger
  std::vector<ArmBody> bodies;
  JointFigures7 start_rad{};
  double most_opening_m = 0.09;
};

// A body that stands where it is. On top of one that is a surface things may stand.
struct FixedBody {
  std::string name;
  ConvexSolid solid;
  Frame frame;
  bool surface = false;   // an upright box only
  bool of_robot = false;  // the arms' own stand, which their first joints are near to
};

// As the camera tells them. An obstacle is a blockage, and no object.
enum class ObjectKind : std::uint8_t { Cup = 1, Can = 2, Tray = 3, Box = 4, Obstacle = 5 };

// Its solids: robot_cell_shapes.h. Upright always, so that a pose is x, y, z and yaw.
struct ObjectFigures {
  std::string name;
  ObjectKind kind = ObjectKind::Cup;
  double x_m = 0.0;  // of its middle, where it stands at the start: on what is highest there
  double y_m = 0.0;
  double yaw_rad = 0.0;
  Vec3 size_m;  // length, width, height; of what is round both first are its diameter. 0: of its kind
  double mass_kg = 0.0;  // 0: of its kind
};

// Drives in a cascade: position to speed to acceleration; with these two a step settles without overshoot.
struct DriveFigures {
  double position_gain_1_s = 40.0;
  double time_constant_s = 0.00625;                               // of the speed loop
  JointFigures7 acceleration_rad_s2{10, 10, 12, 12, 20, 20, 20};  // what the motor's torque gives
  JointFigures7 inertia_kgm2{2.0, 2.0, 1.0, 1.0, 0.2, 0.2, 0.1};  // that the weight of a load acts on
  double brake_rad_s2 = 30.0;                                     // of the holding brake
  double following_rad = 0.35;  // a drive that is farther from its set point trips
};

struct HandFigures {
  double speed_m_s = 0.2;  // of the opening
  double gain_1_s = 40.0;
  double force_n = 20.0;  // the most of each finger
  double stiffness_n_m = 20'000.0;
  double friction = 0.4;
  double slide_out_m = 0.02;  // an object that has slid so far in the hand falls out of it
};

struct CameraFigures {
  double delay_s = 0.2;
  double loss = 0.02;    // 0..1: that it does not see an object
  double ghosts = 0.02;  // 0..1: that it reports an object that is not there, in each picture
  double position_m = 0.002;
  double yaw_rad = 0.02;
  double view_low_x_m = 0.0;  // where ghosts are
  double view_low_y_m = -1.0;
  double view_high_x_m = 1.5;
  double view_high_y_m = 1.0;
  std::size_t slots = 0;  // terminals for so many reports; 0: two more than objects and blockages
};

struct EncoderFigures {
  double noise_rad = 1e-5;
  double resolution_rad = 4.8e-5;  // 17 bits to the turn
};

struct RobotCellParameters {
  std::vector<ArmFigures> arms;
  std::vector<FixedBody> fixed;
  std::vector<ObjectFigures> objects;
  // Stand while the fault block_1, block_2, ... holds, from when nothing is in their place.
  std::vector<FixedBody> blockages;
  DriveFigures drive;
  HandFigures hand;
  CameraFigures camera;
  EncoderFigures encoder;
  std::uint64_t seed = 1;
};

// Takes noise, losses and ghosts away; the camera's delay stays.
void make_certain(RobotCellParameters& parameters);

std::size_t camera_slots(const RobotCellParameters& parameters);

// Fails with one C0321 per figure that has no physical sense or that is too many.
[[nodiscard]] result::Result<void> validate(const RobotCellParameters& parameters);

}  // namespace stepwright::assemblies
