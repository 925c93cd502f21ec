#include "supervisor/tamp/planner/packing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "supervisor/motion/spatial/random.h"

namespace stepwright::tamp::planner {
namespace {

double nearest(const PackProblem& problem, const std::vector<PlanePoint>& places) {
  double least = 1.0;
  for (std::size_t a = 0; a < places.size(); ++a) {
    EXPECT_LE(std::abs(places[a].x_m), 0.5 * problem.size_x_m - problem.radii_m[a] + 1e-8);
    EXPECT_LE(std::abs(places[a].y_m), 0.5 * problem.size_y_m - problem.radii_m[a] + 1e-8);
    for (std::size_t b = 0; b < a; ++b)
      least = std::min(least, std::hypot(places[a].x_m - places[b].x_m, places[a].y_m - places[b].y_m) -
                                  problem.radii_m[a] - problem.radii_m[b]);
    for (std::size_t b = 0; b < problem.standing.size(); ++b)
      least = std::min(least, std::hypot(places[a].x_m - problem.standing[b].x_m,
                                         places[a].y_m - problem.standing[b].y_m) -
                                  problem.radii_m[a] - problem.standing_radii_m[b]);
  }
  return least;
}

TEST(Packing, WhenThingsJustFit_ThenTheyArePlaced) {
  const double r = 0.035;
  for (const double slack_m : {0.02, 0.005, 0.001, 0.0003}) {
    for (const auto& [nx, ny] : {std::pair{2, 2}, {3, 1}, {3, 2}, {1, 2}}) {
      PackProblem problem;
      problem.size_x_m = 2 * r * nx + slack_m;
      problem.size_y_m = 2 * r * ny + slack_m;
      problem.radii_m.assign(static_cast<std::size_t>(nx * ny), r);
      const auto places = spread(problem);
      ASSERT_TRUE(places) << nx << " x " << ny << ", " << slack_m;
      EXPECT_GE(nearest(problem, *places), -1e-8);
      if (nx * ny <= 4) {
        EXPECT_GT(nearest(problem, *places), 0.3 * slack_m - 1e-4);
      }
      problem.radii_m.push_back(r);
      if (nx * ny == 4) {
        EXPECT_FALSE(pack(problem));
      }
    }
  }
}

TEST(Packing, WhenRandomThingsArePlaced_ThenNoneMeetAndNoneIsOutside) {
  motion::Random random(3);
  int packed = 0;
  for (int k = 0; k < 300; ++k) {
    PackProblem problem;
    problem.size_x_m = random.between(0.1, 0.3);
    problem.size_y_m = random.between(0.1, 0.3);
    problem.apart_m = random.between(0.0, 0.01);
    const std::size_t count = 1 + random.below(5);
    for (std::size_t n = 0; n < count; ++n) problem.radii_m.push_back(random.between(0.02, 0.05));
    if (random.unit() < 0.5) {
      problem.standing.push_back({random.between(-0.1, 0.1), random.between(-0.1, 0.1)});
      problem.standing_radii_m.push_back(0.03);
    }
    const auto places = pack(problem, 3'000);
    if (!places) continue;
    ++packed;
    EXPECT_GE(nearest(problem, *places), problem.apart_m - 1e-8);
  }
  EXPECT_GT(packed, 100);
}

TEST(Packing, WhenABoundIsGiven_ThenNothingIsEverPackedBeyondIt) {
  motion::Random random(4);
  for (int k = 0; k < 200; ++k) {
    PackProblem problem;
    problem.size_x_m = random.between(0.08, 0.25);
    problem.size_y_m = random.between(0.08, 0.25);
    const double r = 0.035;
    const std::size_t most = most_that_fit(problem.size_x_m, problem.size_y_m, r, 0.0);
    ASSERT_GE(most, 1u);
    for (std::size_t count = 0; count < 12; ++count)
      EXPECT_EQ(too_many(count, problem.size_x_m, problem.size_y_m, r, 0.0), count > most) << count;
    problem.radii_m.assign(most + 1, r);
    EXPECT_FALSE(pack(problem, 3'000));
  }
  EXPECT_EQ(most_that_fit(0.16, 0.16, 0.035, 0.0), 4u);
  EXPECT_EQ(most_that_fit(0.06, 0.5, 0.035, 0.0), 0u);
}

}  // namespace
}  // namespace stepwright::tamp::planner
