#include "supervisor/fleet/mission/internal/drawn_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace stepwright::fleet::internal {
namespace {

using geometry::Pose;
using geometry::Travel;
using ::testing::HasSubstr;

constexpr double kQuarter = 0.5 * std::numbers::pi;

TEST(DrawnPath, Poses_WhenOnAnArc_ThenJoinedAlongIt) {
  const std::vector<Pose> poses = {{0, 0, 0}, {10, 0, 0}, {15, 5, kQuarter}};
  const DrawnPath drawn = join_poses(poses, {});
  ASSERT_EQ(drawn.fault, "");
  EXPECT_NEAR(drawn.path.back().arc_m, 10.0 + 5.0 * kQuarter, 1e-9);
  for (const auto& at : drawn.path) {
    EXPECT_EQ(at.travel, Travel::Forward);
    if (at.pose.x_m > 10.0) {
      EXPECT_NEAR(std::hypot(at.pose.x_m - 10.0, at.pose.y_m - 5.0), 5.0, 1e-9);
    }
  }
  for (std::size_t k = 1; k < drawn.path.size(); ++k) {
    EXPECT_LE(geometry::distance(drawn.path[k - 1].pose.position(), drawn.path[k].pose.position()), 0.0501);
  }
}

TEST(DrawnPath, Poses_WhenBehindOneAnother_ThenDrivenInReverse) {
  const std::vector<Pose> poses = {{10, 0, 0}, {5, 0, 0}, {8, 0, 0}};
  const DrawnPath drawn = join_poses(poses, {});
  ASSERT_EQ(drawn.fault, "");
  EXPECT_EQ(drawn.path.front().travel, Travel::Reverse);
  EXPECT_EQ(drawn.path.back().travel, Travel::Forward);
  EXPECT_NEAR(drawn.path.back().arc_m, 8.0, 1e-9);
}

TEST(DrawnPath, Poses_WhenNoVehicleDrivesSo_ThenTheFirstWrongOneIsNamed) {
  const std::vector<Pose> sideways = {{0, 0, 0}, {5, 0, 0}, {5, 3, 0}};
  EXPECT_EQ(join_poses(sideways, {}).wrong, 2u);
  EXPECT_THAT(join_poses(sideways, {}).fault, HasSubstr("no arc leads there"));
  const std::vector<Pose> tight = {{0, 0, 0}, {2, 2, kQuarter}};
  EXPECT_THAT(join_poses(tight, {}).fault, HasSubstr("a radius of 2.00 m; 3.50 m is the least"));
  EXPECT_THAT(join_poses({}, {}).fault, HasSubstr("no poses"));
}

}  // namespace
}  // namespace stepwright::fleet::internal
