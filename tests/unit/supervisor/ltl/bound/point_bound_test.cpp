#include "supervisor/ltl/bound/point_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numbers>
#include <queue>

#include "supervisor/ltl/guide/task.h"
#include "supervisor/ltl/scene/places.h"
#include "tests/unit/supervisor/ltl/regions/floors.h"

namespace stepwright::ltl {
namespace {

using geometry::Point;
using testing::Rectangle;
using testing::Squares;

constexpr double kPiece_m = 0.25;

std::optional<double> bound_m(const Floor& floor, const std::string& text, Point from,
                              const BoundOptions& options = {.piece_m = kPiece_m}) {
  Problem problem;
  problem.floor = floor;
  problem.start.x_m = from.x_m;
  problem.start.y_m = from.y_m;
  problem.task = text;
  return point_bound_m(problem, options);
}

TEST(PointBound, WhenAWayIsKnown_ThenTheBoundIsBelowItByNoMoreThanAPieceForEachPlace) {
  Floor floor;
  floor.border = Rectangle{0, 0, 20, 20}.area("border");
  floor.obstacles = {Rectangle{6, 0, 7, 10}.area("wall")};
  floor.propositions = {Rectangle{10, 2, 12, 4}.area("press"), Rectangle{16, 2, 18, 4}.area("rack"),
                        Rectangle{13, 0, 15, 20}.area("belt")};
  const Point start{2.0, 3.0};
  const double around =
      std::hypot(4.0, 7.0) + 1.0 + std::hypot(3.0, 6.0);  // over the wall's end, to a corner
  const auto expect_near = [&](const std::string& task, double way_m, double places) {
    const auto bound = bound_m(floor, task, start);
    ASSERT_TRUE(bound) << task;
    EXPECT_LE(*bound, way_m + 1e-9) << task;
    EXPECT_GE(*bound, way_m - places * kPiece_m) << task;
  };
  expect_near("visit press", around, 1.0);
  // From the wall's end straight to the rack, through the belt.
  expect_near("visit rack", std::hypot(4.0, 7.0) + 1.0 + std::hypot(9.0, 6.0), 1.0);
  // Along the upper side of the press.
  expect_near("visit press then visit rack", std::hypot(4.0, 7.0) + 1.0 + std::hypot(5.0, 6.0) + 4.0, 2.0);
  expect_near("visit press | visit rack", around, 1.0);
  expect_near("!press U belt", std::hypot(4.0, 7.0) + 1.0 + 6.0, 1.0);
  EXPECT_EQ(bound_m(floor, "!belt U rack", start), PointBound::kNever) << "the belt is from wall to wall";
  EXPECT_EQ(bound_m(floor, "visit press", {11.0, 3.0}), 0.0);
}

// A run that goes on: the way is that to what is left.
TEST(PointBound, WhenLettersWereReadBefore_ThenOnlyTheRestIsMeasured) {
  Problem problem;
  problem.floor.border = Rectangle{0, 0, 20, 20}.area("border");
  problem.floor.propositions = {Rectangle{2, 2, 4, 4}.area("press"), Rectangle{14, 2, 18, 6}.area("rack")};
  problem.start = {8.0, 3.0, 0.0};
  problem.task = "visit press then visit rack";
  const auto expect_near = [&](double way_m, double pieces) {
    const auto bound = point_bound_m(problem);
    ASSERT_TRUE(bound);
    EXPECT_LE(*bound, way_m + 1e-9);
    EXPECT_GE(*bound, way_m - pieces * kPiece_m);
  };
  expect_near(4.0 + 10.0, 2.0);
  problem.read = {0, 1};
  expect_near(6.0, 1.0);
  problem.read = {0, 1, 0};
  expect_near(6.0, 1.0);
  problem.read = {0, 1, 2};
  EXPECT_EQ(point_bound_m(problem), 0.0);
  problem.task = "!rack U press";
  problem.read = {0, 2};
  EXPECT_EQ(point_bound_m(problem), PointBound::kNever) << "it is broken already";
  // Letters count: the start is the letter that was read last, not another one.
  problem.task = "X X rack";
  problem.read = {1, 0};
  expect_near(6.0, 1.0);
}

TEST(PointBound, WhenAPlaceIsForbidden_ThenTheWayLeadsAroundIt) {
  Floor floor;
  floor.border = Rectangle{0, 0, 20, 20}.area("border");
  floor.propositions = {Rectangle{15, 9, 17, 11}.area("press"), Rectangle{8, 4, 10, 16}.area("wash")};
  const Point start{3.0, 10.0};
  const double straight = 12.0, around = std::hypot(5.0, 6.0) + 2.0 + std::hypot(5.0, 5.0);
  EXPECT_NEAR(*bound_m(floor, "visit press", start), straight, kPiece_m);
  EXPECT_NEAR(*bound_m(floor, "!wash U press", start), around, kPiece_m);
  EXPECT_NEAR(*bound_m(floor, "visit press then visit wash", start), straight + 5.0, 2.0 * kPiece_m);
}

// The shortest way over points 33 cm apart, each with its 48 nearest ones: no shorter than the true one, and
// longer by 1.4 % and some points' distance.
double slowly_m(const Squares& squares, const Automaton& automaton, Point from) {
  constexpr int kScale = 3, kSide = testing::kSize * kScale;
  const Floor floor = squares.floor();
  const Places places(floor.propositions);
  const auto point = [](int x, int y) { return Point{(x + 0.5) / kScale, (y + 0.5) / kScale}; };
  const auto free = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < kSide && y < kSide && squares.is_free(x / kScale, y / kScale);
  };
  const std::size_t states = automaton.size();
  std::vector<double> cost_m(static_cast<std::size_t>(kSide) * kSide * states, PointBound::kNever);
  using Open = std::pair<double, std::size_t>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  const auto reach = [&](int x, int y, std::uint32_t state, double cost) {
    const std::size_t node = static_cast<std::size_t>(y * kSide + x) * states + state;
    if (cost >= cost_m[node]) return;
    cost_m[node] = cost;
    open.emplace(cost, node);
  };
  const int start_x = static_cast<int>(from.x_m * kScale), start_y = static_cast<int>(from.y_m * kScale);
  reach(start_x, start_y, automaton.next(automaton.initial, places.label(from)), 0.0);
  while (!open.empty()) {
    const auto [cost, node] = open.top();
    open.pop();
    if (cost > cost_m[node]) continue;
    const auto state = static_cast<std::uint32_t>(node % states);
    if (automaton.accepting(state)) return cost;
    if (automaton.rejecting(state)) continue;
    const int x = static_cast<int>(node / states) % kSide, y = static_cast<int>(node / states) / kSide;
    for (int dx = -3; dx <= 3; ++dx) {
      for (int dy = -3; dy <= 3; ++dy) {
        if ((dx == 0 && dy == 0) || !free(x + dx, y + dy)) continue;
        // Each square that the way leads through is looked at.
        const Point a = point(x, y), b = point(x + dx, y + dy);
        bool clear = true;
        for (const Rectangle& each : squares.obstacles) {
          for (int n = 1; n < 24 && clear; ++n) {
            const Point at = a + (n / 24.0) * (b - a);
            clear = at.x_m <= each.left || at.x_m >= each.right || at.y_m <= each.low || at.y_m >= each.high;
          }
        }
        if (!clear) continue;
        std::vector<Label> letters;
        places.read(a, b, places.label(a), letters);
        std::uint32_t next = state;
        for (const Label letter : letters) {
          next = automaton.next(next, letter);
          if (automaton.accepting(next) || automaton.rejecting(next)) break;
        }
        if (!automaton.rejecting(next)) reach(x + dx, y + dy, next, cost + geometry::distance(a, b));
      }
    }
  }
  return PointBound::kNever;
}

TEST(PointBound, WhenFloorsAreRandom_ThenItIsThatOfASearchOverManyPoints) {
  int compared = 0, impossible = 0;
  for (std::uint32_t seed = 1; compared < 10; ++seed) {
    const Squares squares = testing::random_squares(seed);
    if (squares.propositions.size() < 2) continue;
    const Floor floor = squares.floor();
    std::vector<std::string> names;
    for (const Area& each : floor.propositions) names.push_back(each.name);
    std::vector<std::string> tasks = {"visit p0 then visit p1", "!p0 U p1"};
    if (names.size() > 2) tasks.push_back("visit p0, visit p2, !p2 U p1");
    Point from{0.0, 0.0};
    for (int k = 0; from == Point{0.0, 0.0}; ++k)
      if (squares.is_free(k, k)) from = {k + 0.5, k + 0.5};
    const std::string& text = tasks[seed % tasks.size()];
    const auto task = read_task(text, names, {}, {.acceptance = Acceptance::Strong});
    ASSERT_TRUE(task);
    const double way_m = slowly_m(squares, task->automaton, from);
    const auto bound = bound_m(floor, text, from);
    ASSERT_TRUE(bound);
    ++compared;
    if (way_m == PointBound::kNever) {
      ++impossible;
      continue;  // where obstacles touch at a corner a point may pass, and the grid does not
    }
    EXPECT_LE(*bound, way_m) << "seed " << seed << ": " << text;
    EXPECT_GE(*bound, 0.97 * way_m - 3.0) << "seed " << seed << ": " << text;
  }
  EXPECT_LT(impossible, compared / 2);
}

TEST(PointBound, WhenABoundIsMet_ThenThereIsNone) {
  Floor floor;
  floor.border = Rectangle{0, 0, 20, 20}.area("border");
  floor.propositions = {Rectangle{15, 9, 17, 11}.area("press")};
  const Point start{3.0, 10.0};
  EXPECT_TRUE(bound_m(floor, "visit press", start));
  EXPECT_FALSE(bound_m(floor, "visit press", start, {.most_points = 20}));
  EXPECT_FALSE(bound_m(floor, "visit press", start, {.most_states = 20}));
  EXPECT_FALSE(bound_m(floor, "visit press", start, {.until = std::chrono::steady_clock::time_point::min()}));
  EXPECT_FALSE(bound_m(floor, "visit nothing", start));
}

}  // namespace
}  // namespace stepwright::ltl
