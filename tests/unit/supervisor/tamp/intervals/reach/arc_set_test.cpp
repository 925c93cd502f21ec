#include "supervisor/tamp/intervals/reach/arc_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace stepwright::tamp {
namespace {

constexpr double kPi = std::numbers::pi;

ArcSet set_of(std::initializer_list<Arc> arcs) {
  ArcSet set;
  for (const Arc arc : arcs) set.add(arc);
  return set;
}

TEST(Angle, WhenItIsConverted_ThenItIsTheNearestUnitOnAnyTurn) {
  EXPECT_EQ(angle_of(0.0), 0u);
  EXPECT_EQ(angle_of(kPi), 0x80000000u);
  EXPECT_EQ(angle_of(-kPi), 0x80000000u);
  EXPECT_EQ(angle_of(0.5 * kPi + 4.0 * kPi), 0x40000000u);
  EXPECT_NEAR(radians_of(angle_of(-2.5)), -2.5, 1e-9);
  EXPECT_NEAR(turn_rad(angle_of(3.0), angle_of(-3.0)), 2.0 * kPi - 6.0, 2e-9);
}

TEST(Arc, WhenItIsRoundedOutward_ThenItHoldsBothEndsAndLittleMore) {
  const Arc arc = arc_outward(-0.7, 2.36);
  EXPECT_LE(radians_of(arc.low), -0.7);
  EXPECT_GE(radians_of(arc.high()), 2.36);
  EXPECT_NEAR(radians_of(arc.low), -0.7, 4e-9);
  EXPECT_NEAR(radians_of(arc.high()), 2.36, 4e-9);
  EXPECT_EQ(arc_outward(0.0, 2.0 * kPi).width, Arc::kFull);
  EXPECT_EQ(arc_outward(-9.0, 9.0).width, Arc::kFull);
}

TEST(ArcSet, WhenArcsLieAcrossTheSeam_ThenTheyAreOneArc) {
  const ArcSet seam = ArcSet::of(arc_outward(3.0, 3.5));
  EXPECT_TRUE(seam.contains(angle_of(kPi)));
  EXPECT_TRUE(seam.contains(angle_of(-3.0)));
  EXPECT_FALSE(seam.contains(angle_of(0.0)));
  EXPECT_EQ(seam.size(), 1u);
  const ArcSet both = set_of({arc_outward(3.0, kPi), arc_outward(-kPi, -2.9)});
  EXPECT_EQ(both.size(), 1u) << "the seam is no gap";
  EXPECT_EQ(intersection_of(both.arcs(), seam.arcs()).size(), 1u);
}

TEST(ArcSet, WhenTwoArcsMeetAtBothEnds_ThenTheIntersectionHasTwoArcs) {
  const ArcSet most = ArcSet::of(arc_outward(-2.0, 2.0)),
               back = ArcSet::of(arc_outward(1.5, 2.0 * kPi - 1.5));
  const ArcSet both = intersection_of(most.arcs(), back.arcs());
  EXPECT_EQ(both.size(), 2u);
  EXPECT_TRUE(both.contains(angle_of(1.7)) && both.contains(angle_of(-1.7)));
  EXPECT_FALSE(both.contains(angle_of(0.0)) || both.contains(angle_of(3.0)));
  ArcSet all = most;
  all.add(back.arcs());
  EXPECT_TRUE(all.is_full());
}

TEST(ArcSet, WhenItIsAsked_ThenMarginNearestAndUnitsAreThoseOfItsArcs) {
  const ArcSet set = set_of({{100, 50}, {4'000'000'000u, 10}});
  EXPECT_EQ(set.margin(120), 20u);
  EXPECT_EQ(set.margin(151), 0u);
  EXPECT_EQ(set.nearest(160), 150u);
  EXPECT_EQ(set.nearest(0), 100u);
  EXPECT_EQ(set.nearest(3'999'999'000u), 4'000'000'000u);
  EXPECT_EQ(set.nearest(130), 130u);
  EXPECT_EQ(set.units(), 62u);
  EXPECT_EQ(ArcSet::full().units(), std::uint64_t{1} << 32);
  EXPECT_EQ(ArcSet::full().margin(7), Arc::kFull);
}

TEST(ArcSet, WhenThereAreTooManyArcs_ThenTheNearestTwoAreOneAndNothingIsLost) {
  ArcSet set;
  std::vector<Arc> arcs;
  for (std::uint32_t k = 0; k < 12; ++k) arcs.push_back({k * 300'000'000u + (k % 2) * 100'000'000u, 1000});
  for (const Arc arc : arcs) set.add(arc);
  EXPECT_EQ(set.size(), ArcSet::kMost);
  for (const Arc arc : arcs) EXPECT_TRUE(set.contains(arc.low) && set.contains(arc.high()));
}

TEST(ArcSet, WhenStepsOfATurnCount_ThenEndsAreOnThem) {
  const auto step = std::uint32_t{1} << 28;
  EXPECT_EQ(at_steps(ArcSet::of({step - 5, step + 10}), 16, 0), ArcSet::of({step, step}));
  EXPECT_TRUE(at_steps(ArcSet::of({step + 1, step - 2}), 16, 0).empty());
  EXPECT_EQ(at_steps(ArcSet::of({step + 1, step - 2}), 16, 7), ArcSet::of({step + 7, 0}));
  EXPECT_TRUE(at_steps(ArcSet::full(), 16, 0).is_full());
}

// Everything beside a circle of 256 angles, each 2^24 units: arcs whose ends are there or just before them.
class Clock {
 public:
  static Arc arc(std::mt19937& random) {
    const auto low = static_cast<std::uint32_t>(random() % 256);
    const auto width = static_cast<std::uint32_t>(1 + random() % 255);
    return {low << 24, (width << 24) - 1};
  }
  static std::vector<bool> hours(const ArcSet& set) {
    std::vector<bool> on(256);
    for (std::uint32_t k = 0; k < 256; ++k) on[k] = set.contains(Angle{k << 24});
    return on;
  }
};

TEST(ArcSet, WhenOperationsAreRandom_ThenTheyAreThoseOfAClockWith256Hours) {
  std::mt19937 random(7);
  for (int round = 0; round < 100; ++round) {
    ArcSet a, b;
    for (auto k = random() % 2 + 1; k > 0; --k) a.add(Clock::arc(random));
    for (auto k = random() % 2 + 1; k > 0; --k) b.add(Clock::arc(random));
    const auto on_a = Clock::hours(a), on_b = Clock::hours(b);
    const auto both = Clock::hours(intersection_of(a.arcs(), b.arcs()));
    const auto sums = Clock::hours(sum_of(a.arcs(), b.arcs()));
    const auto differences = Clock::hours(difference_of(a.arcs(), b.arcs()));
    bool meets = false;
    for (std::uint32_t k = 0; k < 256; ++k) {
      ASSERT_EQ(both[k], on_a[k] && on_b[k]) << round;
      meets = meets || both[k];
      bool sum = false, difference = false;
      for (std::uint32_t j = 0; j < 256; ++j) {
        // An hour's parts from h to just before h + 1: two of them sum up to either of two hours.
        sum = sum || (on_a[j] && (on_b[(k - j) % 256] || on_b[(k - j - 1) % 256]));
        difference = difference || (on_a[j] && on_b[(j - k) % 256]);
      }
      ASSERT_EQ(sums[k], sum) << round << " " << k;
      ASSERT_EQ(differences[k], difference) << round << " " << k;
    }
    ASSERT_EQ(meet(a.arcs(), b.arcs()), meets);
  }
}

}  // namespace
}  // namespace stepwright::tamp
