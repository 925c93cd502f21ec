#include "supervisor/tamp/intervals/search/sequence_search.h"

#include <gtest/gtest.h>

#include "supervisor/tamp/intervals/search/nogoods.h"
#include "tests/support/tamp/experiments.h"

namespace stepwright::tamp {
namespace {

using testing::kLeft;
using testing::kRight;

const testing::TwoArms& arms() {
  static const testing::TwoArms two = testing::two_arms(0.04);
  return two;
}

Check judge(std::span<const Configuration> chain) {
  const Configuration& last = chain.back();
  return arcs_at(arms().model(last.arm), last.tool).contains(last.tool_angle) ? Check::Passed : Check::Never;
}

// Is there a chain of instances at all? Every place and angle is tried: of a pick and a place.
bool exists(const testing::Problem& problem) {
  const WorkCell& cell = problem.cell;
  const Object& cup = cell.objects[0];
  const std::int64_t rise = nanometres_of(cell.grasps[0].height_m);
  const auto reaches = [&](std::size_t arm, Point3 at, Angle angle) {
    at[2] += rise;
    return arcs_at(arms().model(arm), at).contains(angle);
  };
  const Point3 start{nanometres_of(cup.start.x_m), nanometres_of(cup.start.y_m),
                     nanometres_of(cup.start.z_m)};
  const Angle first = angle_of(cup.start.angle_rad), last = angle_of(*problem.sequence[1].final_angle_rad);
  for (const Angle hand : angles_of(problem.how)) {
    if (!reaches(kRight, start, first + hand)) continue;
    for (const Point3& at : squares_of(cell.regions[0], 0.05))
      if (reaches(kRight, at, last + hand)) return true;
  }
  return false;
}

TEST(SequenceSearch, WhenSequencesAreShort_ThenItSolvesWhatHasASolutionAndNothingElse) {
  int solved = 0, unsolved = 0;
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    testing::Problem problem = testing::experiment_1(arms(), seed);
    problem.sequence = {pick(kRight, 0), place(kRight, 0, 0, 0.1 * static_cast<double>(seed % 60) - 3.0)};
    const SearchAnswer answer = search_sequence(problem.cell, problem.sequence, problem.how, judge);
    EXPECT_EQ(answer.outcome == SearchOutcome::Solved, exists(problem)) << seed;
    ++(answer.outcome == SearchOutcome::Solved ? solved : unsolved);
    if (answer.outcome != SearchOutcome::Solved) continue;
    ASSERT_EQ(answer.chain.size(), 2u);
    for (std::size_t k = 1; k <= 2; ++k) EXPECT_EQ(judge({answer.chain.data(), k}), Check::Passed);
    EXPECT_EQ(answer.chain[0].tool_angle - answer.chain[0].angle,
              answer.chain[1].tool_angle - answer.chain[1].angle);
  }
  EXPECT_GT(solved, 10);
  EXPECT_GT(unsolved, 10);
}

TEST(SequenceSearch, WhenExperimentsAreFeasible_ThenSixConfigurationsAreEnough) {
  int solved = 0, refuted = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    for (const bool both : {false, true}) {
      const testing::Problem problem =
          both ? testing::experiment_2(arms(), seed) : testing::experiment_1(arms(), seed);
      const SearchAnswer answer = search_sequence(problem.cell, problem.sequence, problem.how, judge);
      EXPECT_NE(answer.outcome, SearchOutcome::Exhausted) << seed << both;
      EXPECT_TRUE(!answer.refuted || answer.configurations == 0u);
      if (answer.outcome != SearchOutcome::Solved) {
        ++refuted;
        continue;
      }
      ++solved;
      EXPECT_LE(answer.configurations, 6u) << seed << both;
      EXPECT_EQ(answer.chain.size(), 4u);
    }
  }
  EXPECT_GT(solved, 60);
  EXPECT_GT(refuted, 10);
}

TEST(SequenceSearch, WhenAConfigurationIsRefused_ThenAnotherChainComesWithoutAskingTwice) {
  testing::Problem problem = testing::experiment_2(arms(), 1);
  for (std::uint64_t seed = 2;; ++seed) {
    if (search_sequence(problem.cell, problem.sequence, problem.how, judge).outcome == SearchOutcome::Solved)
      break;
    problem = testing::experiment_2(arms(), seed);
  }
  std::vector<std::pair<Configuration, Configuration>> asked;
  std::size_t refusals = 0;
  const Checker grudging = [&](std::span<const Configuration> chain) {
    const std::pair<Configuration, Configuration> step{
        chain.size() > 1 ? chain[chain.size() - 2] : Configuration{}, chain.back()};
    EXPECT_EQ(std::count(asked.begin(), asked.end(), step), 0);
    asked.push_back(step);
    if (chain.size() == 2 && refusals < 5) {
      ++refusals;
      return refusals % 2 == 0 ? Check::Never : Check::NotFrom;
    }
    return judge(chain);
  };
  const SearchAnswer answer = search_sequence(problem.cell, problem.sequence, problem.how, grudging);
  EXPECT_EQ(answer.outcome, SearchOutcome::Solved);
  EXPECT_EQ(refusals, 5u);
  EXPECT_EQ(answer.configurations, asked.size());
  const SearchAnswer limited = search_sequence(problem.cell, problem.sequence, problem.how,
                                               [](auto) { return Check::Never; }, {.most_configurations = 3});
  EXPECT_EQ(limited.configurations, 3u);
  EXPECT_EQ(limited.outcome, SearchOutcome::Exhausted);
}

TEST(Nogoods, WhenASequenceWasRefuted_ThenOthersWithTheSamePartAreToo) {
  WorkCell cell;
  cell.arms = {{"right", &arms().right_table}, {"left", &arms().left_table}};
  cell.grasps = {{"top", 0.34, 0.0, {}}};
  cell.regions = {{"far", 0.5, -1.1, 0.05, 0.2, 0.2, 0.0}, {"near", 0.5, -0.1, 0.05, 0.2, 0.2, 0.0}};
  cell.objects = {{"cup1", {0.5, -0.3, 0.05, 0.0}, 0.1}, {"cup2", {0.5, 0.0, 0.05, 0.0}, 0.1}};
  NogoodStore nogoods(cell);
  EXPECT_FALSE(nogoods.learn(std::vector{pick(kRight, 0), place(kRight, 0, 1)}));
  EXPECT_TRUE(
      nogoods.learn(std::vector{pick(kLeft, 1), place(kLeft, 1, 1), pick(kRight, 0), place(kRight, 0, 0)}));
  ASSERT_EQ(nogoods.size(), 1u);
  EXPECT_EQ(nogoods.text(0), "cup1: right picks cup1, right places cup1 on far");
  EXPECT_TRUE(nogoods.refutes(std::vector{pick(kRight, 0), place(kRight, 0, 0)}));
  EXPECT_TRUE(nogoods.refutes(std::vector{pick(kRight, 0), place(kRight, 0, 1), move_away(kRight),
                                          pick(kRight, 0), pick(kLeft, 1), place(kRight, 0, 0)}));
  EXPECT_FALSE(nogoods.refutes(std::vector{pick(kLeft, 0), place(kLeft, 0, 0)}));
  EXPECT_FALSE(nogoods.refutes(std::vector{pick(kRight, 1), place(kRight, 1, 0)}));
}

}  // namespace
}  // namespace stepwright::tamp
