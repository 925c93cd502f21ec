// A short campaign in every test run, and every seed that was ever lost.

#include "tests/bench/campaign/campaign.h"

#include <gtest/gtest.h>

#include <atomic>

#include "tests/bench/campaign/fleet.h"

namespace stepwright::campaign {
namespace {

const executive::PlanningService& planning() {
  static const executive::PlanningService opened = [] {
    auto made = campaign_planning();
    if (!made) throw std::runtime_error(result::to_string(made.error()));
    return std::move(*made);
  }();
  return opened;
}

TEST(Campaign, WhenDisturbedAtRandom_ThenNoRunIsLost) {
  const Figures figures = campaign(planning(), 0, 55, 2);
  const ClassFigures all = figures.all();
  EXPECT_EQ(all.runs, 55u);
  EXPECT_EQ(all.lost, 0u) << table(figures);
  EXPECT_EQ(all.goals + all.safe_stops, 55u);
  EXPECT_EQ(figures.of[0].goals, 5u);  // undisturbed
  EXPECT_EQ(figures.of[0].replans, 0u);
  EXPECT_GT(all.safe_stops, 0u);
  EXPECT_GT(all.replans, 0u);
}

TEST(Campaign, WhenCancelled_ThenNoFurtherRunBegins) {
  const std::atomic<bool> cancel{true};
  EXPECT_EQ(campaign(planning(), 0, 1'000'000, 2, {}, &cancel).all().runs, 0u);
}

// 2235: a level that a weak pump left at the edge of its tolerance was taken for one that rises by itself,
// and a place on the way for the end of it. 2290: a pump too weak to do anything, found a little late. 1297:
// a wish that came in the state of the replan before it was taken for a plant that does not follow. 1412,
// 1940, 3326, 3458: a sensor that drifted by less than its tolerance at a time. 2945, 8698, 8797: a wish that
// stopped a pump less than a unit before the new goal. 3269, 4446: the same by a weak pump, and the stop did
// not name it. 2950: what a customer had received, in fractions, was a unit short at the end of the plan.
TEST(Campaign, WhenASeedWasLostOnce_ThenItIsNotAgain) {
  for (const std::uint64_t seed : {160u, 1297u, 1412u, 1940u, 2235u, 2290u, 2945u, 2950u, 3269u, 3326u, 3458u,
                                   4446u, 4553u, 4927u, 8698u, 8797u, 9866u}) {
    const RunResult run = run_once(planning(), disturbance_of(seed));
    EXPECT_NE(run.verdict, Verdict::Lost) << seed << ": " << run.why;
  }
}

// Plant, disturbance and scan repeat bit for bit; which of two plans of the same cost is taken may depend on
// the time that is left for repairs.
TEST(Campaign, WhenASeedRunsTwice_ThenItIsDisturbedAndEndsInTheSameWay) {
  for (const std::uint64_t seed : {0u, 1u, 3u, 7u, 10u}) {
    const RunResult a = run_once(planning(), disturbance_of(seed));
    const RunResult b = run_once(planning(), disturbance_of(seed));
    EXPECT_EQ(a.disturbance.story, b.disturbance.story) << seed;
    EXPECT_EQ(a.verdict, b.verdict) << seed;
    ASSERT_EQ(a.record.incidents.empty(), b.record.incidents.empty()) << seed;
    if (a.record.incidents.empty()) continue;
    EXPECT_EQ(a.record.incidents.front().kind, b.record.incidents.front().kind) << seed;
    EXPECT_EQ(a.record.incidents.front().time_s, b.record.incidents.front().time_s) << seed;
    EXPECT_EQ(a.record.incidents.front().evidence, b.record.incidents.front().evidence) << seed;
  }
}

// One of each kind. A job takes seconds: both tests judge the same ones.
const FleetFigures& fleet_figures() {
  static const FleetFigures figures = fleet_campaign(0, 4, 1);
  return figures;
}

TEST(FleetCampaign, WhenSomethingHappensAtARandomMoment_ThenNoRunIsLost) {
  const FleetFigures& figures = fleet_figures();
  EXPECT_EQ(figures.runs(), 4u);
  EXPECT_EQ(figures.of.size(), 5u);  // each kind, and all
  EXPECT_EQ(figures.of.at("all").lost, 0u) << table(figures);
}

TEST(FleetCampaign, WhenAMomentIsDrawnTwice_ThenItIsTheSame) {
  ASSERT_TRUE(fleet_figures().newest);
  const FleetRun& run = *fleet_figures().newest;
  FleetCell cell;
  const FleetRun again = run_fleet(cell, run.moment.seed);
  EXPECT_EQ(run.moment.story, again.moment.story);
  EXPECT_EQ(run.verdict, again.verdict);
  EXPECT_EQ(run.record.message, again.record.message);
  ASSERT_FALSE(run.record.incidents.empty());
  EXPECT_EQ(run.record.incidents.front().time_s, again.record.incidents.front().time_s);
  EXPECT_EQ(run.record.finished_s, again.record.finished_s);
}

}  // namespace
}  // namespace stepwright::campaign
