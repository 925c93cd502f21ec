#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <random>

#include "supervisor/fleet/allocation/allocate.h"
#include "tests/support/fleet/allocation_checker.h"
#include "tests/support/fleet/drawn_transports.h"
#include "tests/unit/supervisor/fleet/allocation/exhaustive_allocation.h"
#include "tests/unit/supervisor/fleet/allocation/random_allocation.h"

namespace stepwright::fleet {
namespace {

using support::TransportKind;
using testing::IsEmpty;

// Large neighbourhood search alone.
constexpr AllocationOptions kNoProof{.iterations = 1000, .exact_trips = 0};

TEST(LargeNeighbourhoods, WhenTheBestIsProved_ThenWhatTheyFindIsNear) {
  for (const TransportKind kind : support::kTransportKinds) {
    double ratios = 0.0;
    constexpr int kProblems = 5;
    for (std::uint64_t seed = 1; seed <= kProblems; ++seed) {
      SCOPED_TRACE(support::name_of(kind) + " " + std::to_string(seed));
      const auto problem = support::draw_transports(kind, 8, 3, seed);
      const AllocationAnswer best = allocate(problem);
      ASSERT_EQ(best.verdict, AllocationVerdict::Optimal);
      const AllocationAnswer found = allocate(problem, kNoProof);
      ASSERT_EQ(found.verdict, AllocationVerdict::Feasible);
      EXPECT_THAT(faults_of(found, problem), IsEmpty());
      const double ratio = static_cast<double>(found.objective) / static_cast<double>(best.objective);
      EXPECT_GE(ratio, 1.0);
      EXPECT_LE(ratio, 1.08);
      ratios += ratio;
    }
    EXPECT_LE(ratios / kProblems, 1.02) << support::name_of(kind);
  }
}

TEST(LargeNeighbourhoods, WhenProblemsAreSmall_ThenBoundsAreNotAboveTheBest) {
  std::mt19937 random(5);
  int found = 0;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const auto problem = draw_allocation({.vehicles = 2, .transports = 2}, random);
    const auto best = best_by_enumeration(problem);
    const AllocationAnswer answer = allocate(problem, {.iterations = 20, .exact_trips = 0, .explain = false});
    EXPECT_FALSE(answer.verdict == AllocationVerdict::Infeasible && best);
    if (answer.verdict != AllocationVerdict::Feasible) continue;
    ++found;
    ASSERT_TRUE(best);
    EXPECT_LE(answer.lower_bound, *best);
    EXPECT_GE(answer.objective, *best);
    EXPECT_THAT(faults_of(answer, problem), IsEmpty());
  }
  EXPECT_GT(found, 80);
}

TEST(LargeNeighbourhoods, WhenProblemsAreOddAndLarge_ThenNoAnswerIsFaulty) {
  std::mt19937 random(6);
  int found = 0;
  for (int i = 0; i < 120; ++i) {
    SCOPED_TRACE(i);
    const auto transports = static_cast<std::uint32_t>(5 + i % 12);
    const auto problem = draw_allocation({.vehicles = 4, .transports = transports, .most_amount = 3}, random);
    const AllocationAnswer answer = allocate(problem, {.iterations = 30, .exact_trips = 0, .explain = false});
    if (answer.verdict != AllocationVerdict::Feasible) continue;
    ++found;
    EXPECT_THAT(faults_of(answer, problem), IsEmpty());
  }
  EXPECT_GT(found, 25);
}

TEST(LargeNeighbourhoods, WhenThereAreTwoHundredTransports_ThenAllAreCarried) {
  for (const TransportKind kind : support::kTransportKinds) {
    SCOPED_TRACE(support::name_of(kind));
    const auto problem = support::draw_transports(kind, 200, 20, 9);
    const AllocationAnswer answer = allocate(problem, {.iterations = 3});
    ASSERT_EQ(answer.verdict, AllocationVerdict::Feasible);
    EXPECT_THAT(faults_of(answer, problem), IsEmpty());
    EXPECT_GT(answer.lower_bound, 0);
  }
}

TEST(LargeNeighbourhoods, WhenTheyGoOn_ThenTheAnswerIsNoWorse) {
  const auto problem = support::draw_transports(TransportKind::Shared, 40, 4, 3);
  const AllocationAnswer first = allocate(problem, {.iterations = 1});
  const AllocationAnswer later = allocate(problem, {.iterations = 300});
  EXPECT_LT(later.objective, first.objective);
  EXPECT_EQ(later.figures.iterations, 300U);
}

TEST(LargeNeighbourhoods, WhenTheSeedIsTheSame_ThenSoIsTheAnswer) {
  const auto problem = support::draw_transports(TransportKind::Coupled, 30, 4, 4);
  const AllocationAnswer first = allocate(problem, {.iterations = 60, .seed = 5});
  const AllocationAnswer again = allocate(problem, {.iterations = 60, .seed = 5});
  ASSERT_EQ(first.verdict, AllocationVerdict::Feasible);
  EXPECT_EQ(first.objective, again.objective);
  for (std::size_t v = 0; v < first.routes.size(); ++v) {
    ASSERT_EQ(first.routes[v].stops.size(), again.routes[v].stops.size());
    for (std::size_t i = 0; i < first.routes[v].stops.size(); ++i) {
      EXPECT_EQ(first.routes[v].stops[i].transport, again.routes[v].stops[i].transport);
      EXPECT_EQ(first.routes[v].stops[i].begin, again.routes[v].stops[i].begin);
    }
  }
}

TEST(LargeNeighbourhoods, WhenTheyAreCancelled_ThenWhatIsThereIsTheAnswer) {
  const std::atomic<bool> cancel = true;
  const auto problem = support::draw_transports(TransportKind::Single, 50, 5, 1);
  const AllocationAnswer answer = allocate(problem, {.iterations = 0, .cancel = &cancel});
  ASSERT_EQ(answer.verdict, AllocationVerdict::Feasible);
  EXPECT_EQ(answer.figures.iterations, 0U);
  EXPECT_THAT(faults_of(answer, problem), IsEmpty());
}

}  // namespace
}  // namespace stepwright::fleet
