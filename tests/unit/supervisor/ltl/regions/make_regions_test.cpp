#include "supervisor/ltl/regions/make_regions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "floors.h"

namespace stepwright::ltl {
namespace {

using geometry::Point;
using testing::kSize;
using testing::random_squares;
using testing::Squares;

double area_of(const RegionMap& map, std::uint32_t i) {
  return cross(map.corner(i, 1) - map.corner(i, 0), map.corner(i, 2) - map.corner(i, 0)) / 2.0;
}

TEST(MakeRegions, Floor_WhenItIsEmpty_ThenIsTwoTriangles) {
  const auto map = make_regions(Squares{}.floor());
  ASSERT_TRUE(map.has_value());
  EXPECT_EQ(map->regions().size(), 2U);
  EXPECT_DOUBLE_EQ(map->area_m2(), kSize * kSize);
}

TEST(MakeRegions, Proposition_WhenItLiesApart_ThenIsCutOutWithItsLabel) {
  const auto map = make_regions(Squares{{}, {{4, 4, 6, 7}}}.floor());
  ASSERT_TRUE(map.has_value());
  double labelled = 0.0;
  for (std::uint32_t i = 0; i < map->regions().size(); ++i)
    if (map->region(i).label == 1) labelled += area_of(*map, i);
  EXPECT_DOUBLE_EQ(labelled, 6.0);
  EXPECT_EQ(map->regions().size(), 2U + 8U);  // of the rectangle, and of the floor with it as a hole
}

// Each square metre of a random floor has the label that the rectangles give it, in triangles of that label.
TEST(MakeRegions, Labels_WhenFloorsAreRandom_ThenHaveTheAreasOfTheirSquares) {
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    const Squares squares = random_squares(seed);
    const auto map = make_regions(squares.floor());
    ASSERT_TRUE(map.has_value()) << seed << ": " << to_string(map.error());
    std::map<Label, double> wanted, found;
    for (int x = 0; x < kSize; ++x)
      for (int y = 0; y < kSize; ++y)
        if (squares.is_free(x, y)) wanted[squares.label(x, y)] += 1.0;
    for (std::uint32_t i = 0; i < map->regions().size(); ++i) {
      EXPECT_GT(area_of(*map, i), 0.0) << seed;
      found[map->region(i).label] += area_of(*map, i);
    }
    ASSERT_EQ(found.size(), wanted.size()) << seed;
    for (const auto& [label, area] : wanted) EXPECT_NEAR(found[label], area, 1e-9) << seed;
  }
}

TEST(MakeRegions, Locate_WhenPointsAreRandom_ThenFindsTheLabelOfTheirSquare) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    const Squares squares = random_squares(seed);
    const auto map = make_regions(squares.floor());
    ASSERT_TRUE(map.has_value());
    std::mt19937 dice(seed);
    std::uniform_real_distribution<double> within(0.001, 0.999);
    for (int k = 0; k < 200; ++k) {
      const int x = static_cast<int>(dice() % kSize), y = static_cast<int>(dice() % kSize);
      const std::uint32_t at = map->locate({x + within(dice), y + within(dice)});
      ASSERT_EQ(at != kNoRegion, squares.is_free(x, y)) << seed;
      if (at != kNoRegion) {
        ASSERT_EQ(map->region(at).label, squares.label(x, y)) << seed;
      }
    }
  }
}

// Whether the side from a to b lies on an outline.
bool on_outline(const Floor& floor, Point a, Point b) {
  const auto on = [&](const Area& area) {
    for (std::size_t k = 0; k < area.ring.size(); ++k) {
      const Point c = area.ring[k], d = area.ring[(k + 1) % area.ring.size()];
      const auto within = [&](Point p) {
        return std::abs(cross(d - c, p - c)) < 1e-9 && dot(p - c, p - d) < 1e-9;
      };
      if (within(a) && within(b)) return true;
    }
    return false;
  };
  for (const Area& area : floor.obstacles)
    if (on(area)) return true;
  for (const Area& area : floor.propositions)
    if (on(area)) return true;
  return on(floor.border);
}

// Positive where d lies in the circle through a, b, c (anticlockwise).
double in_circle(Point a, Point b, Point c, Point d) {
  const Point p = a - d, q = b - d, r = c - d;
  return dot(p, p) * cross(q, r) + dot(q, q) * cross(r, p) + dot(r, r) * cross(p, q);
}

TEST(MakeRegions, Sides_WhenFloorsAreRandom_ThenWallsAreOutlinesAndTheOthersAreDelaunay) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    const Floor floor = random_squares(seed).floor();
    const auto map = make_regions(floor);
    ASSERT_TRUE(map.has_value());
    for (std::uint32_t i = 0; i < map->regions().size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t across = map->region(i).across[k];
        const bool outline = on_outline(floor, map->corner(i, k), map->corner(i, k + 1));
        if (across == kNoRegion) {
          EXPECT_TRUE(outline) << seed;
          continue;
        }
        EXPECT_TRUE(outline || map->region(across).label == map->region(i).label) << seed;
        if (outline) continue;
        const auto& there = map->region(across);
        for (std::size_t q = 0; q < 3; ++q) {
          if (there.across[q] != i) continue;
          const Point opposite = map->corner(across, q + 2);
          EXPECT_LE(in_circle(map->corner(i, 0), map->corner(i, 1), map->corner(i, 2), opposite), 1e-6)
              << seed;
        }
      }
    }
  }
}

TEST(MakeRegions, Strip_WhenItIsAMillimetreWide_ThenIsFound) {
  Floor floor = Squares{}.floor();
  floor.propositions.push_back({"strip", {{5, 0}, {5.001, 0}, {5.001, 20}, {5, 20}}, {}});
  const auto map = make_regions(floor);
  ASSERT_TRUE(map.has_value());
  EXPECT_EQ(map->region(map->locate({5.0005, 13.0})).label, 1U);
  EXPECT_EQ(map->region(map->locate({5.0015, 13.0})).label, 0U);
}

}  // namespace
}  // namespace stepwright::ltl
