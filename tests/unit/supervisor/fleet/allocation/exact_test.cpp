#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "supervisor/fleet/allocation/allocate.h"
#include "tests/support/fleet/allocation_checker.h"
#include "tests/unit/supervisor/fleet/allocation/exhaustive_allocation.h"
#include "tests/unit/supervisor/fleet/allocation/random_allocation.h"

namespace stepwright::fleet {
namespace {

using testing::IsEmpty;

struct Tally {
  int optimal = 0;
  int infeasible = 0;
};

// The allocator's answer against all allocations.
void expect_best(const AllocationProblem& problem, const AllocationOptions& options, Tally& tally) {
  const auto best = best_by_enumeration(problem);
  const AllocationAnswer answer = allocate(problem, options);
  if (!best) {
    EXPECT_EQ(answer.verdict, AllocationVerdict::Infeasible);
    ++tally.infeasible;
    return;
  }
  ASSERT_EQ(answer.verdict, AllocationVerdict::Optimal);
  EXPECT_EQ(answer.objective, *best);
  EXPECT_THAT(faults_of(answer, problem), IsEmpty());
  ++tally.optimal;
}

TEST(BranchAndBound, WhenProblemsAreSmall_ThenTheBestOfAllIsFound) {
  std::mt19937 random(1);
  Tally tally;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const auto transports = static_cast<std::uint32_t>(1 + i % 3);
    const auto problem = draw_allocation({.vehicles = 2, .transports = transports}, random);
    expect_best(problem, {.iterations = 5, .explain = false}, tally);
  }
  EXPECT_GT(tally.optimal, 100);
  EXPECT_GT(tally.infeasible, 40);
}

TEST(BranchAndBound, WhenNothingButTheSearchFindsAllocations_ThenTheBestOfAllIsFound) {
  std::mt19937 random(2);
  Tally tally;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    const auto problem =
        draw_allocation({.vehicles = 3, .transports = 3, .most_amount = 1, .fixed = false}, random);
    expect_best(problem, {.iterations = 1, .seed = 7, .explain = false}, tally);
  }
  EXPECT_GT(tally.optimal, 20);
}

TEST(BranchAndBound, WhenLoadsAreLargerThanVehicles_ThenTheBestDivisionIsFound) {
  std::mt19937 random(3);
  Tally tally;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    const auto problem =
        draw_allocation({.vehicles = 2, .transports = 1, .most_amount = 5, .constraints = false}, random);
    expect_best(problem, {.iterations = 5, .explain = false}, tally);
  }
  EXPECT_GT(tally.optimal, 20);
}

}  // namespace
}  // namespace stepwright::fleet
