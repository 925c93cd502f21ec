#include "plant_models/body2d/body_geometry.h"

#include <gtest/gtest.h>

#include <numbers>

namespace stepwright::body2d {
namespace {

constexpr Rectangle kBox = {{0.4, 0.2}};

TEST(BodyGeometry, WhenAPointIsTakenToThePlaneAndBack_ThenItIsTheSame) {
  const Pose pose{{3.0, -2.0}, 0.7};
  const Vec2 back = to_own(pose, to_plane(pose, {0.3, -0.1}));
  EXPECT_NEAR(back.x, 0.3, 1e-15);
  EXPECT_NEAR(back.y, -0.1, 1e-15);
}

TEST(BodyGeometry, WhenTheBoxIsTurned_ThenItsCornersReachAsFarAsTheDiagonalSays) {
  const Pose upright{{0.0, 0.0}, 0.0};
  const Pose turned{{0.0, 0.0}, std::numbers::pi / 2.0};
  EXPECT_TRUE(crosses(kBox, upright, {0.19, 0.0}, {0.19, 0.0}));
  EXPECT_FALSE(crosses(kBox, turned, {0.19, 0.0}, {0.19, 0.0}));
  EXPECT_TRUE(crosses(kBox, turned, {0.0, 0.19}, {0.0, 0.19}));
}

struct BeamCase {
  const char* name;
  Vec2 from;
  Vec2 to;
  bool seen;
};

class BodyGeometryBeam : public testing::TestWithParam<BeamCase> {};

TEST_P(BodyGeometryBeam, WhenABeamIsDrawn_ThenItIsInterruptedExactlyByWhatLiesOnIt) {
  const BeamCase& c = GetParam();
  EXPECT_EQ(crosses(kBox, {{1.0, 1.0}, 0.0}, c.from, c.to), c.seen);
  EXPECT_EQ(crosses(kBox, {{1.0, 1.0}, 0.0}, c.to, c.from), c.seen);
}

INSTANTIATE_TEST_SUITE_P(Beams, BodyGeometryBeam,
                         testing::Values(BeamCase{"Through", {1.1, 0.0}, {1.1, 2.0}, true},
                                         BeamCase{"Beside", {1.21, 0.0}, {1.21, 2.0}, false},
                                         BeamCase{"OnTheEdge", {1.2, 0.0}, {1.2, 2.0}, true},
                                         BeamCase{"TooShort", {1.1, 0.0}, {1.1, 0.89}, false},
                                         BeamCase{"Slanted", {0.7, 0.8}, {1.3, 1.2}, true},
                                         BeamCase{"PastACorner", {1.15, 0.7}, {1.45, 1.3}, false},
                                         BeamCase{"PointInside", {1.0, 1.05}, {1.0, 1.05}, true},
                                         BeamCase{"PointOutside", {1.0, 1.15}, {1.0, 1.15}, false},
                                         BeamCase{"InsideAltogether", {0.95, 1.0}, {1.05, 1.0}, true}),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace stepwright::body2d
