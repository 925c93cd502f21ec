#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <random>
#include <vector>

#include "supervisor/fleet/schedule/schedule.h"
#include "tests/unit/supervisor/fleet/schedule/exhaustive.h"
#include "tests/unit/supervisor/fleet/schedule/random_problem.h"

namespace stepwright::fleet {
namespace {

using std::chrono::milliseconds;
using namespace std::chrono_literals;

// Whether all orders of what the core names, and of nothing else, fail.
bool refuted(const Problem& problem, const Core& core, Mode mode) {
  Problem left;
  std::vector<std::uint32_t> renamed(problem.envelopes.size());
  for (const std::uint32_t v : core.vehicles) {
    renamed[v] = static_cast<std::uint32_t>(left.envelopes.size());
    left.envelopes.push_back(problem.envelopes[v]);
    if (std::ranges::find(core.slowest, v) != core.slowest.end()) continue;
    for (EnvelopePolygon& polygon : left.envelopes.back().polygons) {
      polygon.stay.most = polygon.overlap.most = milliseconds(kHorizon_ms);
    }
  }
  for (const std::uint32_t c : core.constraints) {
    TemporalConstraint constraint = problem.constraints[c];
    constraint.to.at.vehicle = renamed[constraint.to.at.vehicle];
    if (constraint.from) constraint.from->at.vehicle = renamed[constraint.from->at.vehicle];
    left.constraints.push_back(constraint);
  }
  std::vector<SpatialPair> pairs;
  for (const auto& section : core.sections) {
    for (SpatialPair pair : section) {
      pair.a.vehicle = renamed[pair.a.vehicle];
      pair.b.vehicle = renamed[pair.b.vehicle];
      pairs.push_back(pair);
    }
  }
  return !try_all_orders(left, mode, 0, &pairs).feasible;
}

// All cores with one part less.
std::vector<Core> smaller(const Core& core) {
  std::vector<Core> all;
  const auto leave_out = [&](auto member) {
    for (std::size_t k = 0; k < (core.*member).size(); ++k) {
      all.push_back(core);
      (all.back().*member).erase((all.back().*member).begin() + static_cast<std::ptrdiff_t>(k));
    }
  };
  leave_out(&Core::sections);
  leave_out(&Core::constraints);
  leave_out(&Core::slowest);
  return all;
}

TEST(Core, Explain_WhenProblemsAreRandom_ThenWhatItNamesFailsInAllOrdersAndNothingOfItCanBeLeftOut) {
  std::mt19937 random(21);
  int infeasible = 0, parts = 0;
  for (int round = 0; round < 700; ++round) {
    const Mode mode = round % 2 ? Mode::Strict : Mode::EarliestTimes;
    const Problem problem = random_problem(3, 4, random);
    const Schedule made = schedule(problem.envelopes, problem.constraints, {.mode = mode});
    if (made.verdict != Verdict::Infeasible) continue;
    ++infeasible;
    ASSERT_TRUE(made.core.minimal);
    EXPECT_TRUE(refuted(problem, made.core, mode)) << round;
    for (const Core& core : smaller(made.core)) {
      ++parts;
      EXPECT_FALSE(refuted(problem, core, mode)) << round;
    }
    EXPECT_FALSE(to_string(made.core, problem.envelopes, problem.constraints).empty());
  }
  EXPECT_GT(infeasible, 100);
  EXPECT_GT(parts, 200);
}

TEST(Core, Explain_WhenADeadlineIsImpossible_ThenItIsNamedAloneWithItsVehicle) {
  const std::vector<TrajectoryEnvelope> envelopes = {lane("a", 0, 6, 0.0, 9s), lane("b", 0, 6, 5.0, 9s)};
  const std::vector<TemporalConstraint> constraints = {
      {"a in time", {}, {{0, 5}, Side::Exit}, {0s, 90s}},
      {"b in time", {}, {{1, 5}, Side::Exit}, {0s, 3s}},
  };
  const Schedule made = schedule(envelopes, constraints, {});
  ASSERT_EQ(made.verdict, Verdict::Infeasible);
  EXPECT_EQ(made.core.vehicles, std::vector<std::uint32_t>{1});
  EXPECT_EQ(made.core.constraints, std::vector<std::uint32_t>{1});
  EXPECT_TRUE(made.core.sections.empty());
  EXPECT_TRUE(made.core.slowest.empty());
  EXPECT_EQ(to_string(made.core, envelopes, constraints), "constraint 'b in time'\n");
}

TEST(Core, Explain_WhenTwoDeadlinesExcludeEachOther_ThenBothAndTheSectionAreNamed) {
  const std::vector<TrajectoryEnvelope> envelopes = {lane("a", 0, 6, 0.0, 100s), lane("b", 5, -1, 0.0, 100s),
                                                     lane("c", 0, 6, 9.0, 100s)};
  const std::vector<TemporalConstraint> constraints = {
      {"a in time", {}, {{0, 5}, Side::Exit}, {0s, 8s}},
      {"b in time", {}, {{1, 5}, Side::Exit}, {0s, 8s}},
      {"c in time", {}, {{2, 5}, Side::Exit}, {0s, 8s}},
  };
  const Schedule made = schedule(envelopes, constraints, {.mode = Mode::EarliestTimes});
  ASSERT_EQ(made.verdict, Verdict::Infeasible);
  EXPECT_EQ(made.core.vehicles, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(made.core.constraints.size(), 2u);
  EXPECT_EQ(made.core.sections.size(), 1u);
  EXPECT_TRUE(made.core.slowest.empty());
}

}  // namespace
}  // namespace stepwright::fleet
