#include "supervisor/translate/stn.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace stepwright::translate {
namespace {

TEST(Stn, WhenBoundsChain_ThenEarliestAndLatestLeaveTheSlackBetween) {
  Stn stn(4);
  stn.at_least(0, 1, 2.0);
  stn.at_least(1, 3, 3.0);
  stn.at_least(0, 2, 1.0);
  stn.at_least(2, 3, 1.0);
  const auto early = stn.earliest();
  ASSERT_TRUE(early);
  EXPECT_EQ(*early, (std::vector<double>{0.0, 2.0, 1.0, 5.0}));
  const auto late = stn.latest(3, 5.0);
  ASSERT_TRUE(late);
  EXPECT_EQ(*late, (std::vector<double>{0.0, 2.0, 4.0, 5.0}));
  EXPECT_FALSE(stn.latest(3, 4.9));
}

TEST(Stn, WhenAMaximumHoldsEventsTogether_ThenTheLaterOnePullsTheFirst) {
  Stn stn(3);
  stn.at_least(0, 2, 10.0);
  stn.at_most(1, 2, 4.0);
  EXPECT_EQ(*stn.earliest(), (std::vector<double>{0.0, 6.0, 10.0}));
}

TEST(Stn, WhenBoundsContradict_ThenThereAreNoTimes) {
  Stn stn(3);
  stn.at_least(0, 1, 1.0);
  stn.at_least(1, 2, 3.0);
  stn.at_most(1, 2, 2.0);
  EXPECT_FALSE(stn.earliest());
  stn.pop();
  EXPECT_TRUE(stn.earliest());
  stn.at_most(0, 1, 0.5);
  EXPECT_FALSE(stn.earliest());
}

// Against all shortest paths (Floyd, Warshall), the textbook form of the same network.
TEST(Stn, WhenBoundsAreRandom_ThenTimesAreThoseOfAllShortestPaths) {
  constexpr std::size_t kEvents = 7;
  std::mt19937 random(3);
  const auto pick = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
  int consistent = 0;
  for (int round = 0; round < 400; ++round) {
    Stn stn(kEvents);
    std::vector<std::vector<double>> most(kEvents, std::vector<double>(kEvents, 1e9));
    for (std::size_t i = 0; i < kEvents; ++i) {
      most[i][i] = 0.0;
      most[i][0] = 0.0;  // nothing happens before event 0
    }
    for (int bound = 0; bound < 9; ++bound) {
      const auto from = static_cast<std::size_t>(pick(kEvents));
      const auto to = static_cast<std::size_t>(pick(kEvents));
      if (from == to) continue;
      const double seconds = pick(9) - 1;
      if (pick(3) == 0) {
        stn.at_most(from, to, seconds + 12);
        most[from][to] = std::min(most[from][to], seconds + 12);
      } else {
        stn.at_least(from, to, seconds);
        most[to][from] = std::min(most[to][from], -seconds);
      }
    }
    for (std::size_t k = 0; k < kEvents; ++k) {
      for (std::size_t i = 0; i < kEvents; ++i) {
        for (std::size_t j = 0; j < kEvents; ++j) most[i][j] = std::min(most[i][j], most[i][k] + most[k][j]);
      }
    }
    bool possible = true;
    for (std::size_t i = 0; i < kEvents; ++i) possible = possible && most[i][i] >= 0.0;
    const auto times = stn.earliest();
    ASSERT_EQ(times.has_value(), possible) << round;
    if (!times) continue;
    ++consistent;
    for (std::size_t i = 0; i < kEvents; ++i) EXPECT_NEAR((*times)[i], -most[i][0], 1e-6) << round;
  }
  EXPECT_GT(consistent, 100);
}

}  // namespace
}  // namespace stepwright::translate
