#include "cell/runtime/robot_cell_plant.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "cell/runtime/cell_io.h"
#include "plant_models/assemblies/robot_cell_arm.h"
#include "supervisor/motion/kinematics/chain.h"
#include "supervisor/motion/robot/urdf_reader.h"
#include "supervisor/motion/spatial/random.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::cell_runtime {
namespace {

constexpr const char* kUrdf = STEPWRIGHT_SOURCE_DIR "/tests/cells/robot_cell/two_arms.urdf";
const std::string kArms =
    "[[plant.arms]]\nname = \"left\"\nstart_rad = [0, 0.5, 0, 1, 0, 0, 0]\n"
    "[[plant.arms]]\nname = \"right\"\nstart_rad = [0, 0.5, 0, 1, 0, 0, 0]\n";
const std::string kTable =
    "[[plant.fixed]]\nname = \"table\"\nx_m = 0.8\ny_m = 0\nz_m = 0.35\nlength_m = 0.4\nwidth_m = "
    "1.2\nheight_m = 0.7\n";
const std::string kCup = "[[plant.objects]]\nname = \"cup\"\nkind = \"cup\"\nx_m = 0.8\ny_m = 0.1\n";
const std::string kImage = "[image]\ninput_bytes = 160\noutput_bytes = 40\n";

class RobotCellPlant : public testing::Test {
 protected:
  config::CellReading read(const std::string& plant) {
    const std::filesystem::path file = folder_.path() / "cell.toml";
    std::ofstream(file) << "[plant]\nkind = \"robot_cell\"\nrobot = \"" << kUrdf << "\"\n"
                        << plant << kImage << "[cell]\nstate_dir = \"" << folder_.path().string() << "\"\n";
    return config::read_cell_config(file);
  }
  void expect(const std::string& plant, const std::string& code, const std::string& part,
              std::uint32_t line) {
    auto reading = read(plant);
    const result::Diagnostics problems =
        reading.problems.empty() ? check_cell_io(reading.config) : reading.problems;
    ASSERT_FALSE(problems.empty()) << plant;
    EXPECT_EQ(problems.front().code, code) << result::to_string(problems);
    EXPECT_EQ(problems.front().where.line, line) << result::to_string(problems);
    EXPECT_NE(result::to_string(problems).find(part), std::string::npos) << result::to_string(problems);
  }

  support::TemporaryFolder folder_;
};

TEST_F(RobotCellPlant, WhenTheRobotIsRead_ThenItsFramesAreThoseOfThePlanner) {
  const auto reading = read(kArms + kTable + kCup);
  ASSERT_TRUE(reading.problems.empty()) << result::to_string(reading.problems);
  EXPECT_TRUE(check_cell_io(reading.config).empty()) << result::to_string(check_cell_io(reading.config));
  const auto parameters = robot_cell_parameters(reading.config.plant);
  ASSERT_TRUE(parameters) << result::to_string(parameters.error());
  std::ifstream in(kUrdf);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto robot = motion::read_urdf(text, kUrdf).value();
  motion::Random random(5);
  for (std::size_t arm = 0; arm < 2; ++arm) {
    const assemblies::ArmFigures& figures = parameters->arms[arm];
    const auto chain = motion::Chain::between(robot, 0, robot.link(figures.name + "_tcp")).value();
    for (int k = 0; k < 100; ++k) {
      std::array<double, 7> q{};
      for (std::size_t j = 0; j < 7; ++j)
        q[j] = random.between(figures.joints[j].lower_rad, figures.joints[j].upper_rad);
      const motion::Transform tip = chain.forward(q);
      const assemblies::Frame tool = assemblies::arm_pose(figures, q).tool;
      for (std::size_t m = 0; m < 9; ++m) EXPECT_NEAR(tool.turn.m[m], tip.rotation.m[m], 1e-12);
      EXPECT_NEAR(tool.place.x, tip.position_m.x, 1e-12);
      EXPECT_NEAR(tool.place.y, tip.position_m.y, 1e-12);
      EXPECT_NEAR(tool.place.z, tip.position_m.z, 1e-12);
    }
    // Fingers open along the tool's y, to both sides; the pads are the opening apart.
    const assemblies::ArmPose pose = assemblies::arm_pose(figures, figures.start_rad);
    double least = 1.0;
    double most = -1.0;
    for (const assemblies::ArmBody& body : figures.bodies) {
      if (body.slide == assemblies::Vec3{}) continue;
      const assemblies::Vec3 at =
          pose.tool.turn.back(assemblies::placed(body, pose, 0.07).frame.place - pose.tool.place);
      least = std::min(least, at.y);
      most = std::max(most, at.y);
    }
    EXPECT_NEAR(most, 0.035 + 0.006, 1e-9);
    EXPECT_NEAR(least, -0.035 - 0.006, 1e-9);
    EXPECT_EQ(figures.most_opening_m, 0.09);
    EXPECT_EQ(figures.bodies.size(), 12u);
  }
  EXPECT_EQ(parameters->fixed.size(), 4u);  // table, base, two of the torso
}

TEST_F(RobotCellPlant, WhenTheCellIsWrong_ThenWhatIsToBlameIsNamedAtItsPlace) {
  expect(kTable, "C0006", "one or two arms", 2);
  expect("[[plant.arms]]\nname = \"left\"\ntip = \"left_hook\"\n", "C0322", "left_hook", 4);
  expect("[[plant.arms]]\nname = \"left\"\ntip = \"left_wrist\"\n", "C0322", "6 joints", 4);
  expect("[[plant.arms]]\nname = \"left\"\ngripper = \"claw\"\n", "C0322", "claw", 4);
  expect("[[plant.arms]]\nname = \"left\"\nstart_rad = [0, 0, 0, -1, 0, 0, 0]\n", "C0322", "left_joint_4", 4);
  expect("[[plant.arms]]\nname = \"left\"\nstart_rad = [0, 0, 0]\n", "C0004", "seven numbers", 6);
  expect(
      kArms + kTable + kCup + "[[plant.objects]]\nname = \"can\"\nkind = \"can\"\nx_m = 0.82\ny_m = 0.12\n",
      "C0322", "cup is in can", 23);
  expect(kArms + kCup + kCup, "C0006", "two things", 16);
  expect(kArms + "[plant.drive]\nacceleration_rad_s2 = [1, 1, 1, 1, 1, 1, 0]\n", "C0004", "seven numbers",
         11);
  expect(kArms + "[plant.hand]\nforce = 3\n", "C0002", "force_n", 11);
  expect(kArms + "[[faults]]\nat_s = 1.0\nname = \"shift_x_cup\"\nvalue = 1.0\n", "C0311", "shift_x_cup", 12);
}

}  // namespace
}  // namespace stepwright::cell_runtime
