#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/bench/reach/filter_domain.h"
#include "tests/bench/reach/paper_search.h"
#include "tests/support/tamp/experiments.h"

namespace stepwright::bench {
namespace {

using tamp::Check;
using tamp::Configuration;
using tamp::SearchOutcome;

const tamp::testing::TwoArms& arms() {
  static const tamp::testing::TwoArms two = tamp::testing::two_arms(0.05);
  return two;
}

Check judge(std::span<const Configuration> chain) {
  const Configuration& last = chain.back();
  return arcs_at(arms().model(last.arm), last.tool).contains(last.tool_angle) ? Check::Passed : Check::Never;
}

// The numbers of the paper: a cup at (0.6, 0.25, 0.1), grasped from 0.34 m above it.
TEST(FilterDomain, WhenThePapersCupIsPicked_ThenTheDomainIsThePapers) {
  const tamp::ReachGrid grid{{0, 0, 0}, {100'000'000, 100'000'000, 100'000'000}, {10, 10, 10}};
  const auto map = tamp::ReachTable::fill(grid, [](const tamp::Box& cell) {
    const bool is_here = cell[0].contains(600'000'000) && cell[1].contains(250'000'000);
    return tamp::ArcSet::of(is_here ? tamp::arc_outward(-0.70, 2.36) : tamp::arc_outward(-2.0, 3.0));
  });
  tamp::WorkCell cell;
  cell.arms = {{"right", &map}};
  cell.grasps = {{"top", 0.34, 0.0, {}}};
  cell.objects = {{"cup", {0.6, 0.25, 0.1, 0.0}, 0.1}};
  const std::vector sequence = {tamp::pick(0, 0)};
  FilterDomain filter(cell, sequence, 0);
  const auto domain = filter.filter(filter.initial());
  ASSERT_TRUE(domain);
  ASSERT_EQ(domain->size(), 8u);
  const double tool[] = {0.6, 0.25, 0.44};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR((*domain)[4 + axis].low, tool[axis], 1e-6);
    EXPECT_NEAR((*domain)[4 + axis].high, tool[axis], 1e-6);
  }
  EXPECT_NEAR((*domain)[7].low, -0.70, 1e-6);
  EXPECT_NEAR((*domain)[7].high, 2.36, 1e-6);
}

// The baselines judge as ours does: what they solve is solved, what they refute is not solved by anybody.
TEST(ReachBench, WhenProblemsAreRandom_ThenBaselinesAgreeWithOurs) {
  int solved = 0, refuted = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    tamp::testing::Problem problem = tamp::testing::experiment_1(arms(), seed);
    problem.sequence = {tamp::pick(0, 0), tamp::place(0, 0, 0, 0.2 * static_cast<double>(seed) - 3.0)};
    const auto ours = tamp::search_sequence(problem.cell, problem.sequence, problem.how, judge);
    const auto dfs =
        depth_first(problem.cell, problem.sequence, problem.how, judge, Order::Row, {.most_s = 600.0});
    const auto saf = search_and_filter(problem.cell, problem.sequence, problem.how, judge, Order::Row, 1e-3,
                                       {.most_s = 600.0});
    EXPECT_EQ(ours.outcome, dfs.outcome) << seed;
    EXPECT_EQ(ours.outcome, saf.outcome) << seed;
    EXPECT_LE(saf.configurations, dfs.configurations) << seed;
    EXPECT_TRUE(ours.refuted || !saf.refuted) << seed << ": bounds are no wider than the paper's planes";
    ++(ours.outcome == SearchOutcome::Solved ? solved : refuted);
  }
  EXPECT_GT(solved, 2);
  EXPECT_GT(refuted, 2);
}

TEST(ReachBench, WhenOrdersDiffer_ThenEachTriesAllInstances) {
  tamp::testing::Problem problem = tamp::testing::experiment_1(arms(), 1);
  problem.sequence = {tamp::pick(0, 0)};
  for (const Order order : kOrders) {
    std::vector<tamp::Angle> tried;
    const auto answer = depth_first(problem.cell, problem.sequence, problem.how,
                                    [&](auto chain) {
                                      tried.push_back(chain.back().tool_angle);
                                      return Check::Never;
                                    },
                                    order, {.most_s = 600.0});
    EXPECT_EQ(answer.configurations, 16u) << name_of(order);
    EXPECT_EQ(answer.outcome, SearchOutcome::Infeasible);
    std::ranges::sort(tried);
    EXPECT_EQ(std::ranges::unique(tried).size(), 0u);
  }
}

}  // namespace
}  // namespace stepwright::bench
