#include "supervisor/fleet/schedule/sections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/unit/supervisor/fleet/schedule/random_problem.h"

namespace stepwright::fleet {
namespace {

using std::chrono::milliseconds;
using namespace std::chrono_literals;

Sections sections_of(const std::vector<TrajectoryEnvelope>& envelopes) {
  return merge_sections(overlapping_pairs(envelopes), envelopes);
}

TEST(Sections, OverlappingPairs_WhenPolygonsAreRandom_ThenTheyAreThoseOfAllComparisons) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    const Problem problem = random_problem(4, 6, random);
    std::vector<SpatialPair> expected;
    for (std::uint32_t v = 0; v < 4; ++v) {
      for (std::uint32_t w = v + 1; w < 4; ++w) {
        const auto& a = problem.envelopes[v].polygons;
        const auto& b = problem.envelopes[w].polygons;
        for (std::uint32_t i = 0; i < a.size(); ++i) {
          for (std::uint32_t k = 0; k < b.size(); ++k) {
            if (geometry::overlaps(a[i].area, b[k].area)) expected.push_back({{v, i}, {w, k}});
          }
        }
      }
    }
    EXPECT_EQ(overlapping_pairs(problem.envelopes), expected);
  }
}

TEST(Sections, Merge_WhenVehiclesMeetHeadOn_ThenOneSectionWithOneConstraintForEachOrder) {
  const std::vector<TrajectoryEnvelope> envelopes = {lane("a", 0, 6, 0.0, 9s), lane("b", 5, -1, 0.0, 9s)};
  const Sections sections = sections_of(envelopes);
  ASSERT_EQ(sections.sections.size(), 1u);
  EXPECT_EQ(sections.sections[0].pairs, 16u);
  const Motion motion(envelopes, {});
  for (const int side : {0, 1}) {
    std::vector<Constraint> constraints;
    append_precedences(motion, sections.pairs, side, Mode::EarliestTimes, 7, constraints);
    // Who comes second waits before its first shared polygon until the other one has left its last.
    ASSERT_EQ(constraints.size(), 1u);
    const auto first = static_cast<std::uint32_t>(side);
    EXPECT_EQ(constraints[0].from, motion.timepoint({first, 5}, Side::Exit));
    EXPECT_EQ(constraints[0].to, motion.timepoint({1 - first, 0}, Side::Entry));
  }
}

TEST(Sections, Merge_WhenOneFollowsTheOther_ThenOneSectionWithAConstraintForEachPolygon) {
  const std::vector<TrajectoryEnvelope> envelopes = {lane("a", 0, 6, 0.0, 9s), lane("b", 0, 6, 0.0, 9s)};
  const Sections sections = sections_of(envelopes);
  ASSERT_EQ(sections.sections.size(), 1u);
  const Motion motion(envelopes, {});
  std::vector<Constraint> constraints;
  append_precedences(motion, sections.pairs, 0, Mode::EarliestTimes, 7, constraints);
  EXPECT_EQ(constraints.size(), 5u);
  for (const Constraint& c : constraints) {
    EXPECT_LE(motion.polygon_of(c.from).polygon, motion.polygon_of(c.to).polygon + 1);
  }
}

TEST(Sections, Merge_WhenTheyMeetTwice_ThenTwoSections) {
  TrajectoryEnvelope detour = lane("b", 0, 6, 0.0, 9s);
  for (const std::size_t k : {2u, 3u}) {
    const auto x = static_cast<double>(k);
    detour.polygons[k].area = rectangle(x - 0.2, 0.9, x + 1.3, 3.0);
  }
  detour.polygons[2].area = rectangle(1.9, 1.01, 3.0, 3.0);
  detour.polygons[3].area = rectangle(2.9, 1.01, 4.1, 3.0);
  const std::vector<TrajectoryEnvelope> envelopes = {lane("a", 0, 6, 0.0, 9s), detour};
  EXPECT_EQ(sections_of(envelopes).sections.size(), 2u);
}

TEST(Sections, Merge_WhenDone_ThenEachPairIsInOneSection) {
  std::mt19937 random(2);
  for (int round = 0; round < 200; ++round) {
    const Problem problem = random_problem(4, 6, random);
    const auto pairs = overlapping_pairs(problem.envelopes);
    Sections sections = merge_sections(pairs, problem.envelopes);
    for (const CriticalSection& section : sections.sections) {
      ASSERT_GT(section.pairs, 0u);
      for (const SpatialPair& pair : sections.of(section)) {
        EXPECT_EQ(pair.a.vehicle, section.a);
        EXPECT_EQ(pair.b.vehicle, section.b);
      }
    }
    std::ranges::sort(sections.pairs);
    auto expected = pairs;
    std::ranges::sort(expected);
    EXPECT_EQ(sections.pairs, expected);
  }
}

}  // namespace
}  // namespace stepwright::fleet
