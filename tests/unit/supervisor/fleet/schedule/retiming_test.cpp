#include "supervisor/fleet/schedule/retiming.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "tests/support/fleet/schedule_checker.h"
#include "tests/unit/supervisor/fleet/schedule/random_problem.h"

namespace stepwright::fleet {
namespace {

using std::chrono::milliseconds;
using namespace std::chrono_literals;

// After any delay that is accepted the new times must keep vehicles apart; what is refused must be
// impossible.
TEST(Retiming, NotBefore_WhenDelaysAreRandom_ThenTimesStaySoundWithoutSearch) {
  std::mt19937 random(31);
  int accepted = 0, refused = 0;
  for (int round = 0; round < 2500; ++round) {
    const Problem problem = random_problem(3, 5, random);
    const Schedule made = schedule(problem.envelopes, problem.constraints, {.mode = Mode::Strict});
    if (made.verdict != Verdict::Scheduled) continue;
    Retiming retiming(problem.envelopes, problem.constraints, made);
    EXPECT_EQ(retiming.earliest(), made.earliest);
    for (int delay = 0; delay < 4; ++delay) {
      const auto vehicle = static_cast<std::uint32_t>(random() % problem.envelopes.size());
      const auto polygon = static_cast<std::uint32_t>(random() % problem.envelopes[vehicle].polygons.size());
      const TimepointRef late{{vehicle, polygon}, random() % 2 ? Side::Entry : Side::Exit};
      const milliseconds time = retiming.earliest(late) + milliseconds(random() % 6);
      const auto before = retiming.earliest();
      const PolygonTimes& latest = made.latest[vehicle][polygon];
      const bool possible = time <= (late.side == Side::Entry ? latest.entry : latest.exit);
      if (retiming.not_before(late, time)) {
        ++accepted;
        EXPECT_GE(retiming.earliest(late), time);
        EXPECT_EQ(faults_of(retiming.earliest(), problem.envelopes, problem.constraints, Mode::Strict),
                  std::vector<std::string>{});
      } else {
        ++refused;
        EXPECT_EQ(retiming.earliest(), before);
        const auto broken = retiming.broken();
        EXPECT_FALSE(broken.constraints.empty() && broken.slowest.empty());
      }
      // One delay alone can be met up to the latest time.
      if (delay == 0) {
        EXPECT_EQ(possible, retiming.earliest(late) >= time);
      }
    }
  }
  EXPECT_GT(accepted, 100);
  EXPECT_GT(refused, 30);
}

TEST(Retiming, NotBefore_WhenADeadlineBreaks_ThenItIsNamedWithThePrecedence) {
  const milliseconds ever{100'000'000};
  TrajectoryEnvelope across{.vehicle = "b", .polygons = {}};
  for (int y = -3; y < 4; ++y) {
    across.polygons.push_back({rectangle(3.2, y, 3.9, y + 1.1), {1s, ever}, {200ms, ever}});
  }
  const std::vector<TrajectoryEnvelope> envelopes = {lane("a", 0, 8, 0.0, ever), across};
  const std::vector<TemporalConstraint> constraints = {
      {"b in time", {}, {{1, 6}, Side::Exit}, {0s, 30s}},
      {"a first", TimepointRef{{0, 7}, Side::Exit}, {{1, 5}, Side::Entry}, {0s, 30s}},
  };
  const Schedule made = schedule(envelopes, constraints, {.mode = Mode::Strict});
  ASSERT_EQ(made.verdict, Verdict::Scheduled);
  Retiming retiming(envelopes, constraints, made);
  EXPECT_TRUE(retiming.not_before({{0, 3}, Side::Exit}, 10s));
  EXPECT_FALSE(retiming.not_before({{0, 3}, Side::Exit}, 60s));
  EXPECT_EQ(retiming.broken().constraints.front(), 0u);
}

}  // namespace
}  // namespace stepwright::fleet
