#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "floors.h"

namespace stepwright::ltl {
namespace {

using testing::Squares;

void expect_refused(const Floor& floor, const std::string& code, const std::string& text) {
  const auto map = make_regions(floor);
  ASSERT_FALSE(map.has_value());
  EXPECT_EQ(map.error().front().code, code);
  EXPECT_EQ(map.error().front().where.line, 3U);
  EXPECT_NE(map.error().front().message.find(text), std::string::npos) << map.error().front().message;
  EXPECT_FALSE(map.error().front().hint.empty());
}

Floor with_obstacle(std::vector<geometry::Point> ring) {
  Floor floor = Squares{}.floor();
  floor.obstacles.push_back({"rack", std::move(ring), {"floor.json", 3, 5}});
  return floor;
}

TEST(WrongFloor, Corners_WhenThereAreTooMany_ThenTheOutlineIsNamed) {
  std::vector<geometry::Point> round;
  for (std::size_t k = 0; k < 2 * kMostCorners; ++k) {
    const double angle = 6.283185307179586 * static_cast<double>(k) / (2.0 * kMostCorners);
    round.push_back({10.0 + 5.0 * std::cos(angle), 10.0 + 5.0 * std::sin(angle)});
  }
  expect_refused(with_obstacle(round), "L0208", "with 'rack' the floor has more than 100000 corners");
}

TEST(WrongFloor, Time_WhenItIsOver_ThenThereAreNoRegions) {
  // A grid of posts, each a hole: the looks at the time are between them.
  Floor floor = Squares{}.floor();
  for (int k = 0; k < 64; ++k)
    floor.obstacles.push_back(
        testing::Rectangle{1 + 2 * (k % 8), 1 + 2 * (k / 8), 2 + 2 * (k % 8), 2 + 2 * (k / 8)}.area("post"));
  std::size_t looks = 0;
  ASSERT_TRUE(make_regions(floor, [&] { return ++looks == 0; }));
  EXPECT_GT(looks, 3u * 64u);
  for (std::size_t most = 0; most < looks; most += 17) {
    std::size_t count = 0;
    const auto map = make_regions(floor, [&] { return count++ == most; });
    ASSERT_FALSE(map) << most;
    EXPECT_EQ(map.error().front().code, kStoppedRegions);
    EXPECT_EQ(count, most + 1);
  }
}

TEST(WrongFloor, Outline_WhenItHasTwoPoints_ThenIsRefused) {
  expect_refused(with_obstacle({{1, 1}, {2, 2}}), "L0201", "'rack'");
}

TEST(WrongFloor, Coordinate_WhenItIsNoLength_ThenIsRefused) {
  for (const double wrong : {std::nan(""), std::numeric_limits<double>::infinity(), 1e300})
    expect_refused(with_obstacle({{1, 1}, {2, 2}, {wrong, 3}}), "L0202", "'rack'");
}

TEST(WrongFloor, Outline_WhenItCrossesItself_ThenTheCrossingIsNamed) {
  expect_refused(with_obstacle({{1, 1}, {3, 3}, {3, 1}, {1, 3}}), "L0203", "(2.0");
}

TEST(WrongFloor, Outline_WhenItsPointsLieOnALine_ThenIsRefused) {
  expect_refused(with_obstacle({{1, 1}, {2, 2}, {3, 3}}), "L0203", "'rack'");
}

TEST(WrongFloor, Proposition_WhenItReachesBeyondTheBorder_ThenIsRefused) {
  expect_refused(Squares{{}, {{18, 18, 22, 19}}}.floor(), "L0204", "'p0' reaches beyond");
}

TEST(WrongFloor, Proposition_WhenItMeetsAnObstacle_ThenBothAreNamed) {
  expect_refused(Squares{{{2, 2, 6, 6}}, {{5, 5, 8, 8}}}.floor(), "L0204", "'p0' meets the obstacle 'o0'");
}

TEST(WrongFloor, Obstacles_WhenTheyCoverEverything_ThenThereIsNoFloor) {
  expect_refused(Squares{{{0, 0, 20, 20}}, {}}.floor(), "L0205", "cover");
}

TEST(WrongFloor, Propositions_WhenThereAreMoreThanBits_ThenAreRefused) {
  Squares squares;
  squares.propositions.assign(kMostPropositions + 1, {1, 1, 2, 2});
  expect_refused(squares.floor(), "L0206", "64");
}

TEST(WrongFloor, Faults_WhenThereAreSeveral_ThenAllAreTold) {
  Floor floor = with_obstacle({{1, 1}});
  floor.propositions.push_back({"dock", {{1, 1}, {3, 3}, {3, 1}, {1, 3}}, {}});
  const auto map = make_regions(floor);
  ASSERT_FALSE(map.has_value());
  EXPECT_EQ(map.error().size(), 2U);
}

}  // namespace
}  // namespace stepwright::ltl
