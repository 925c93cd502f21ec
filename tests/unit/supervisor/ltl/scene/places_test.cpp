#include "supervisor/ltl/scene/places.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/supervisor/ltl/regions/floors.h"

namespace stepwright::ltl {
namespace {

using geometry::Point;
using testing::Rectangle;

std::vector<Label> read(const Places& places, Point from, Point to) {
  std::vector<Label> letters;
  places.read(from, to, places.label(from), letters);
  return letters;
}

TEST(Places, WhenFloorsAreRandom_ThenWaysReadWhatManyPointsOfThemHave) {
  std::mt19937 dice(9);
  // Off the lattice of corners, so that no way leads along a side.
  std::uniform_real_distribution<double> place(0.0, testing::kSize);
  int changes = 0;
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    const testing::Squares squares = testing::random_squares(seed);
    const Floor floor = squares.floor();
    const Places places(floor.propositions);
    for (int round = 0; round < 40; ++round) {
      const Point from{place(dice), place(dice)}, to{place(dice), place(dice)};
      EXPECT_EQ(places.label(from), squares.label(static_cast<int>(from.x_m), static_cast<int>(from.y_m)));
      std::vector<Label> expected;
      Label last = places.label(from);
      for (int k = 1; k <= 20'000; ++k) {
        const Point at = from + (k / 20'000.0) * (to - from);
        const Label label = squares.label(static_cast<int>(at.x_m), static_cast<int>(at.y_m));
        if (label != last) expected.push_back(label);
        last = label;
      }
      const auto letters = read(places, from, to);
      // Points may miss a corner that is cut by less than a millimetre.
      EXPECT_GE(letters.size(), expected.size());
      if (letters.size() == expected.size()) {
        EXPECT_EQ(letters, expected);
      }
      changes += static_cast<int>(expected.size());
    }
  }
  EXPECT_GT(changes, 500);
}

TEST(Places, WhenAStripIsThin_ThenItIsRead) {
  const std::vector<Area> strips = {{"strip", {{5, 0}, {5.001, 0}, {5.001, 9}, {5, 9}}, {}}};
  const Places places(strips);
  EXPECT_EQ(read(places, {0, 1}, {9, 2}), (std::vector<Label>{1, 0}));
  EXPECT_EQ(read(places, {0, 1}, {4.99, 2}), std::vector<Label>{});
  EXPECT_EQ(read(places, {5.0005, 1}, {9, 1}), std::vector<Label>{0});
}

TEST(Places, WhenAWayGoesOnInPieces_ThenNoLetterIsLostBetweenThem) {
  const std::vector<Area> area = {Rectangle{2, 0, 6, 4}.area("a")};
  const Places places(area);
  // Pieces end at the outline, or by a part of a nanometre beyond it.
  for (const double beyond : {-1e-10, 0.0, 1e-10}) {
    std::vector<Label> letters;
    Label here = 0;
    here = places.read({0, 2}, {2 + beyond, 2}, here, letters);
    here = places.read({2 + beyond, 2}, {6 + beyond, 2}, here, letters);
    here = places.read({6 + beyond, 2}, {8, 2}, here, letters);
    EXPECT_EQ(letters, (std::vector<Label>{1, 0})) << beyond;
    EXPECT_EQ(here, 0u);
  }
}

TEST(Places, WhenAWayPassesPlaces_ThenThoseNearToItAreNamed) {
  const std::vector<Area> areas = {Rectangle{2, 0, 6, 4}.area("a"), Rectangle{8, 0, 9, 4}.area("b")};
  const Places places(areas);
  EXPECT_EQ(places.near({0, 4.5}, {20, 4.5}, 0.6), 3u);
  EXPECT_EQ(places.near({0, 4.5}, {20, 4.5}, 0.4), 0u);
  EXPECT_EQ(places.near({3, 1}, {3, 2}, 0.1), 1u) << "within";
  EXPECT_EQ(places.near({7.7, -5}, {7.7, 5}, 0.4), 2u);
}

}  // namespace
}  // namespace stepwright::ltl
