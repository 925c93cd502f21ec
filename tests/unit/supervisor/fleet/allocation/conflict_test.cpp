#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <random>

#include "supervisor/fleet/allocation/allocate.h"
#include "tests/unit/supervisor/fleet/allocation/exhaustive_allocation.h"
#include "tests/unit/supervisor/fleet/allocation/random_allocation.h"

namespace stepwright::fleet {
namespace {

std::size_t parts_of(const AllocationConflict& conflict) {
  return conflict.transports.size() + conflict.constraints.size() + conflict.vehicles.size() +
         conflict.orders.size() + conflict.routes.size();
}

// What is named leaves no allocation, and without any one part of it there is one.
void expect_minimal(const AllocationConflict& conflict, const AllocationProblem& problem) {
  EXPECT_TRUE(conflict.minimal);
  EXPECT_FALSE(best_by_enumeration(reduced_to(conflict, problem)));
  for (std::size_t part = 0; part < parts_of(conflict); ++part) {
    SCOPED_TRACE(part);
    EXPECT_TRUE(best_by_enumeration(reduced_to(conflict, problem, part)));
  }
}

TEST(AllocationConflict, WhenThereIsNoAllocation_ThenTheReasonIsMinimal) {
  std::mt19937 random(4);
  int infeasible = 0;
  std::size_t most_parts = 0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const auto problem = draw_allocation({.vehicles = 2, .transports = 3}, random);
    const AllocationAnswer answer = allocate(problem, {.iterations = 5});
    if (answer.verdict != AllocationVerdict::Infeasible) continue;
    ++infeasible;
    expect_minimal(answer.conflict, problem);
    most_parts = std::max(most_parts, parts_of(answer.conflict));
  }
  EXPECT_GT(infeasible, 30);
  EXPECT_GE(most_parts, 3U);
}

}  // namespace
}  // namespace stepwright::fleet
