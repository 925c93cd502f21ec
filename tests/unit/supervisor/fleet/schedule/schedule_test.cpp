#include "supervisor/fleet/schedule/schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/fleet/schedule_checker.h"
#include "tests/unit/supervisor/fleet/schedule/exhaustive.h"
#include "tests/unit/supervisor/fleet/schedule/random_problem.h"

namespace stepwright::fleet {
namespace {

using std::chrono::milliseconds;
using namespace std::chrono_literals;

constexpr milliseconds kDue{8};

Schedule solve(const Problem& problem, Mode mode, Objective objective = Objective::None) {
  return schedule(problem.envelopes, problem.constraints,
                  {.mode = mode,
                   .objective = objective,
                   .due = std::vector<milliseconds>(problem.envelopes.size(), kDue)});
}

void expect_sound(const Schedule& made, const Problem& problem, Mode mode) {
  EXPECT_EQ(faults_of(made.earliest, problem.envelopes, problem.constraints, mode),
            std::vector<std::string>{});
  if (mode != Mode::Strict) return;
  EXPECT_EQ(faults_of(made.latest, problem.envelopes, problem.constraints, mode), std::vector<std::string>{});
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const auto times = random_times(made, problem.envelopes, problem.constraints, seed);
    ASSERT_FALSE(times.empty());
    EXPECT_EQ(faults_of(times, problem.envelopes, problem.constraints, mode), std::vector<std::string>{});
  }
}

class AllOrders : public testing::TestWithParam<Mode> {};
INSTANTIATE_TEST_SUITE_P(Schedule, AllOrders, testing::Values(Mode::EarliestTimes, Mode::Strict),
                         [](const auto& mode) {
                           return mode.param == Mode::Strict ? "Strict" : "EarliestTimes";
                         });

// Verdicts, makespans and tardiness against all orders of all single pairs: merging and learning lose
// nothing.
TEST_P(AllOrders, Schedule_WhenProblemsAreRandom_ThenItAgrees) {
  std::mt19937 random(11);
  int scheduled = 0, infeasible = 0;
  std::size_t most_pairs = 0;
  for (int round = 0; round < 3000; ++round) {
    const Problem problem = random_problem(2 + round % 3, 5, random);
    const Exhaustive all = try_all_orders(problem, GetParam(), kDue.count());
    most_pairs = std::max(most_pairs, all.pairs);
    const Schedule made = solve(problem, GetParam());
    ASSERT_EQ(made.verdict == Verdict::Scheduled, all.feasible) << round;
    (all.feasible ? scheduled : infeasible) += 1;
    if (!all.feasible) continue;
    ASSERT_NO_FATAL_FAILURE(expect_sound(made, problem, GetParam())) << round;
    const Schedule quick = solve(problem, GetParam(), Objective::Makespan);
    EXPECT_TRUE(quick.proved_optimal);
    EXPECT_EQ(quick.objective.count(), all.makespan_ms) << round;
    EXPECT_EQ(quick.lower_bound, quick.objective);
    const Schedule punctual = solve(problem, GetParam(), Objective::TotalTardiness);
    EXPECT_EQ(punctual.objective.count(), all.tardiness_ms) << round;
    ASSERT_NO_FATAL_FAILURE(expect_sound(punctual, problem, GetParam())) << round;
  }
  EXPECT_GT(scheduled, 100);
  EXPECT_GT(infeasible, 150);
  EXPECT_GT(most_pairs, 12u);
}

TEST(Schedule, Strict_WhenAVehicleIsParkedInTheWay_ThenInfeasibleAndOnlyThere) {
  Problem problem{{lane("a", 0, 6, 0.0, 9s), lane("parked", 3, 4, 0.0, 9s)}, {}};
  EXPECT_EQ(solve(problem, Mode::Strict).verdict, Verdict::Infeasible);
  EXPECT_EQ(solve(problem, Mode::EarliestTimes).verdict, Verdict::Scheduled);
}

TEST(Schedule, Strict_WhenAVehicleMayStop_ThenOneWaitsAtTheCrossing) {
  const milliseconds ever{100'000'000};
  Problem problem{{lane("a", 0, 6, 0.0, ever)}, {}};
  TrajectoryEnvelope across{.vehicle = "b", .polygons = {}};
  for (int y = -3; y < 4; ++y) {
    across.polygons.push_back({rectangle(3.2, y, 3.9, y + 1.1), {1s, ever}, {200ms, ever}});
  }
  problem.envelopes.push_back(across);
  const Schedule made = solve(problem, Mode::Strict, Objective::Makespan);
  ASSERT_EQ(made.verdict, Verdict::Scheduled);
  expect_sound(made, problem, Mode::Strict);
  EXPECT_EQ(made.figures.sections, 1u);
  EXPECT_FALSE(made.conflicts.empty());
  EXPECT_EQ(made.precedences.size(), 1u);
  EXPECT_TRUE(made.proved_optimal);
}

TEST(Schedule, EarliestTimes_WhenNothingOverlapsInTime_ThenNoPrecedenceIsPosted) {
  Problem problem{{lane("a", 0, 9, 0.0, 9s), lane("b", 0, 6, 0.0, 9s)}, {}};
  problem.envelopes[1].polygons.front().area = rectangle(0.1, -5.0, 0.9, 0.5);
  problem.envelopes[0].polygons.front().area = rectangle(-1.0, 0.0, 0.1, 1.0);
  problem.constraints.push_back({"b later", {}, {{1, 0}, Side::Entry}, {60s, 90s}});
  const Schedule made = solve(problem, Mode::EarliestTimes);
  ASSERT_EQ(made.verdict, Verdict::Scheduled);
  EXPECT_TRUE(made.precedences.empty());
  EXPECT_TRUE(made.conflicts.empty());
  EXPECT_FALSE(solve(problem, Mode::Strict).precedences.empty());
}

TEST(Schedule, Schedule_WhenCancelled_ThenItSaysSo) {
  const std::atomic<bool> cancel{true};
  Problem problem{{lane("a", 0, 6, 0.0, 9s), lane("b", 0, 6, 5.0, 9s)}, {}};
  const Schedule made = schedule(problem.envelopes, {}, {.cancel = &cancel});
  EXPECT_EQ(made.verdict, Verdict::Cancelled);
}

TEST(Schedule, Schedule_WhenThereAreNoVehicles_ThenItIsDone) {
  EXPECT_EQ(schedule({}, {}, {}).verdict, Verdict::Scheduled);
}

// Many vehicles that follow each other through one lane: the search must not need a single conflict.
TEST(Schedule, Strict_WhenManyFollowEachOther_ThenTheFirstDescentSucceeds) {
  Problem problem;
  for (int v = 0; v < 30; ++v) {
    TrajectoryEnvelope envelope = lane("v" + std::to_string(v), -2 * v, 12, 0.0, 100'000s);
    // Each ends in a bay of its own.
    envelope.polygons.push_back({rectangle(12, -3.0 * v, 14, 0.5), {1s, 100'000s}, {}});
    envelope.polygons.push_back({rectangle(13, -3.0 * v, 16 + 2 * v, 1.0 - 3.0 * v), {1s, 100'000s}, {}});
    envelope.polygons.push_back({rectangle(40, 5.0 * v, 42, 5.0 * v + 1), {1s, 100'000s}, {}});
    problem.envelopes.push_back(std::move(envelope));
  }
  const Schedule made = solve(problem, Mode::Strict);
  ASSERT_EQ(made.verdict, Verdict::Scheduled);
  EXPECT_EQ(made.figures.conflicts, 0u);
  expect_sound(made, problem, Mode::Strict);
}

}  // namespace
}  // namespace stepwright::fleet
