#include "supervisor/ltl/route/route_graph.h"

#include <gtest/gtest.h>

#include "tests/unit/supervisor/ltl/regions/floors.h"

namespace stepwright::ltl {
namespace {

using geometry::Point;

TEST(RouteGraph, WhenFloorsAreRandom_ThenWaysKeepTheirMarginAndReadTheirLabels) {
  std::size_t ways = 0, words = 0;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const Floor floor = testing::random_squares(seed).floor();
    const Places places(floor.propositions);
    const Walls walls(floor, {.length_m = 0.4, .width_m = 0.2});
    const RouteGraph graph(floor, places, walls, {.margin_m = 0.2, .wanted_m = 0.6});
    for (std::uint32_t from = 0; from < graph.points().size(); ++from) {
      const Point a = graph.points()[from];
      EXPECT_EQ(graph.label(from), places.label(a));
      for (const RouteGraph::Way& way : graph.ways(from)) {
        const Point b = graph.points()[way.to];
        ++ways;
        EXPECT_NEAR(way.length_m, geometry::distance(a, b), 1e-9);
        EXPECT_GE(way.cost_m, way.length_m - 1e-9);
        // Half a step between two looks at the walls.
        const double least = std::min({0.2, walls.clearance_m(a), walls.clearance_m(b)}) - 0.075;
        for (int k = 0; k <= 50; ++k)
          ASSERT_GT(walls.clearance_m(a + (k / 50.0) * (b - a)), least - 0.15)
              << seed;  // and a cell of theirs
        std::vector<Label> letters;
        places.read(a, b, places.label(a), letters);
        EXPECT_EQ(graph.word(way.word), letters);
        words += letters.empty() ? 0 : 1;
      }
    }
  }
  EXPECT_GT(ways, 5000u);
  EXPECT_GT(words, 500u);
}

TEST(RouteGraph, WhenAWallIsBetween_ThenNoWayLeadsThroughIt) {
  Floor floor;
  floor.border = testing::Rectangle{0, 0, 20, 20}.area("border");
  // Thin, and the ways begin near to it.
  floor.obstacles = {{"sheet", {{10, 0}, {10.001, 0}, {10.001, 15}, {10, 15}}, {}}};
  const Places places({});
  const Walls walls(floor, {.length_m = 0.2, .width_m = 0.1});
  const RouteGraph graph(floor, places, walls, {.margin_m = 0.02});
  RouteGraph::Words words;
  for (const double apart : {0.03, 0.05, 0.1, 0.5, 3.0})
    for (double y = 0.5; y < 14.5; y += 0.37)
      EXPECT_FALSE(graph.way({10.0 - apart, y}, {10.001 + apart, y + 0.1}, words)) << apart << " " << y;
  EXPECT_TRUE(graph.way({9.0, 16.0}, {11.0, 16.0}, words));
}

TEST(RouteGraph, WhenAPlaceIsNarrow_ThenItHasPointsAllTheSame) {
  Floor floor;
  floor.border = testing::Rectangle{0, 0, 20, 20}.area("border");
  // A corner of strips of 5 cm: its middle is outside of it.
  floor.propositions = {
      {"angle", {{5, 5}, {9, 5}, {9, 5.05}, {5.05, 5.05}, {5.05, 9}, {5, 9}}, {}},
  };
  const Places places(floor.propositions);
  const Walls walls(floor, {});
  const RouteGraph graph(floor, places, walls, {});
  std::size_t within = 0;
  for (std::uint32_t k = 0; k < graph.points().size(); ++k) within += graph.label(k) == 1 ? 1 : 0;
  EXPECT_GE(within, 4u);
}

TEST(RouteGraph, WhenThereAreManyCorners_ThenSomeOfThemAreLeftOut) {
  Floor floor;
  floor.border = testing::Rectangle{0, 0, 60, 60}.area("border");
  for (int x = 0; x < 15; ++x)
    for (int y = 0; y < 15; ++y)
      floor.obstacles.push_back(testing::Rectangle{1 + 3 * x, 1 + 3 * y, 2 + 3 * x, 2 + 3 * y}.area("post"));
  floor.propositions = {testing::Rectangle{52, 52, 56, 56}.area("a")};
  const Places places(floor.propositions);
  const Walls walls(floor, {});
  const RouteGraph graph(floor, places, walls, {.margin_m = 0.3, .wanted_m = 0.5, .most_corners = 200});
  EXPECT_GT(graph.points().size(), 150u);
  EXPECT_LT(graph.points().size(), 230u);
  EXPECT_EQ(graph.label(static_cast<std::uint32_t>(graph.points().size() - 5)), 1u)
      << "places have all of theirs";
}

}  // namespace
}  // namespace stepwright::ltl
