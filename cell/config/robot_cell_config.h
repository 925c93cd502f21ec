#pragma once

// The part of [plant] that a robot cell needs:
//
//   [plant]
//   kind = "robot_cell"
//   robot = "two_arms.urdf"   # arms of seven joints that turn; boxes, cylinders and spheres as bodies
//
//   [[plant.arms]]            # one or two
//   name = "left"             # of its terminals
//   tip = "left_tcp"          # link between the finger pads, z away from the hand; default NAME_tcp
//   gripper = "left_gripper"  # the joint that moves a finger; default NAME_gripper
//   start_rad = [0, 0, 0, 1, 0, 0, 0]
//
//   [[plant.fixed]]           # boxes that stand; z_m is of the middle
//   name = "table"
//   x_m = 0.7
//   y_m = 0.0
//   z_m = 0.35
//   heading_deg = 0.0
//   length_m = 0.6            # along heading_deg
//   width_m = 1.2
//   height_m = 0.7
//   surface = true            # things stand on it; the default
//
//   [[plant.objects]]         # at most 16; each stands on what is highest there, in this order
//   name = "cup_1"
//   kind = "cup"              # "cup", "can", "tray", "box"
//   x_m = 0.6
//   y_m = 0.3
//   heading_deg = 0.0
//   length_m = 0.07           # where it is another size (round: the diameter); likewise width_m, height_m
//   mass_kg = 0.2
//
//   [[plant.blockages]]       # boxes that stand while the fault block_1, block_2, ... holds: as fixed
//                             # the camera calls them obstacles
//
//   [plant.drive]             # defaults as here
//   position_gain_1_s = 40.0
//   time_constant_s = 0.00625 # of the speed loop
//   acceleration_rad_s2 = [10, 10, 12, 12, 20, 20, 20]
//   inertia_kgm2 = [2, 2, 1, 1, 0.2, 0.2, 0.1]
//   brake_rad_s2 = 30.0
//   following_rad = 0.35      # a drive farther from its set point trips
//
//   [plant.hand]
//   speed_m_s = 0.2           # of the opening
//   force_n = 20.0            # of each finger
//   stiffness_n_m = 20_000.0
//   friction = 0.4
//   slide_out_m = 0.02        # what has slid so far in the hand falls
//
//   [plant.camera]
//   delay_s = 0.2
//   loss = 0.02               # share of objects that it does not see
//   ghosts = 0.02             # share of reports with an object that is not there
//   position_m = 0.002        # standard deviations
//   yaw_rad = 0.02
//   slots = 6                 # terminals for so many objects; default two more than objects and blockages
//
//   [plant.encoder]
//   noise_rad = 1e-5
//   resolution_rad = 4.8e-5
//
// Thread-safe: pure.

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "cell/config/place_config.h"

namespace stepwright::config {

using SevenNumbers = std::array<double, 7>;

struct ArmConfig {
  std::string name;
  std::string tip;
  std::string gripper;
  SevenNumbers start_rad{};
  result::Location where;
};

struct FixedBodyConfig {
  std::string name;
  PlaceConfig place;
  double z_m = 0.0;
  double length_m = 1.0;
  double width_m = 1.0;
  double height_m = 1.0;
  bool surface = true;
};

struct CellObjectConfig {
  std::string name;
  std::string kind = "cup";
  PlaceConfig place;
  double length_m = 0.0;  // 0: of its kind
  double width_m = 0.0;
  double height_m = 0.0;
  double mass_kg = 0.0;
};

// Defaults are those of plant_models/assemblies/robot_cell_parameters.h, which says what each one is.
struct RobotDriveConfig {
  double position_gain_1_s = 40.0;
  double time_constant_s = 0.00625;
  SevenNumbers acceleration_rad_s2{10, 10, 12, 12, 20, 20, 20};
  SevenNumbers inertia_kgm2{2.0, 2.0, 1.0, 1.0, 0.2, 0.2, 0.1};
  double brake_rad_s2 = 30.0;
  double following_rad = 0.35;
};

struct RobotHandConfig {
  double speed_m_s = 0.2;
  double force_n = 20.0;
  double stiffness_n_m = 20'000.0;
  double friction = 0.4;
  double slide_out_m = 0.02;
};

struct CellCameraConfig {
  double delay_s = 0.2;
  double loss = 0.02;
  double ghosts = 0.02;
  double position_m = 0.002;
  double yaw_rad = 0.02;
  std::size_t slots = 0;
};

struct EncoderConfig {
  double noise_rad = 1e-5;
  double resolution_rad = 4.8e-5;
};

struct RobotCellPlantConfig {
  std::filesystem::path robot;
  result::Location robot_where;
  std::vector<ArmConfig> arms;
  std::vector<FixedBodyConfig> fixed;
  std::vector<CellObjectConfig> objects;
  std::vector<FixedBodyConfig> blockages;
  RobotDriveConfig drive;
  RobotHandConfig hand;
  CellCameraConfig camera;
  EncoderConfig encoder;
};

// Errors are reported to the document of `plant`. Relative paths are taken from `folder`.
RobotCellPlantConfig read_robot_cell_plant(const settings::TomlTable& plant,
                                           const std::filesystem::path& folder);

}  // namespace stepwright::config
