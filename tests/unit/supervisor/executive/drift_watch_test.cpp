#include "supervisor/executive/drift_watch.h"

#include <gtest/gtest.h>

#include "tests/unit/supervisor/executive/bench_fixture.h"

namespace stepwright::executive {
namespace {

using translate::ActionState;
using enum translate::ActionState;

// The bench's sensors, and a plan of three actions: v1 gives three units to a1, a1 gives three to its
// customer, the vehicle moves.
class DriftWatchTest : public ::testing::Test {
 protected:
  DriftWatchTest() {
    const auto action = [&](double v1_before, double v1, double a1_before, double a1) {
      model::PlannedAction planned;
      planned.before.fluents = levels(v1_before, a1_before, 2.0);
      planned.after.fluents = levels(v1, a1, 2.0);
      run_.actions.push_back(std::move(planned));
    };
    action(5.0, 2.0, 2.0, 5.0);
    action(2.0, 2.0, 5.0, 2.0);
    action(2.0, 2.0, 2.0, 2.0);
    watch_.rest(levels(5.0, 2.0, 2.0));
    watch_.follow(run_);
  }

  static DriftWatch::Levels levels(double v1, double a1, double a2) {
    return {{"(lev v1)", v1}, {"(level a1)", a1}, {"(level a2)", a2}};
  }

  void see(double v1, double a1, double a2, std::vector<translate::ActionState> actions) {
    translate::Progress progress;
    progress.actions = std::move(actions);
    watch_.see(levels(v1, a1, a2), progress);
  }

  model::PlannedRun run_;
  DriftWatch watch_{bench_planning().binding()};
};

TEST_F(DriftWatchTest, WhenEverythingGoesAsPlanned_ThenNothingAddsUp) {
  see(5.0, 2.0, 2.0, {Active, Pending, Pending});
  see(3.9, 3.1, 2.0, {Active, Pending, Pending});  // a look half-way, at which nothing is at rest
  see(2.1, 4.9, 2.0, {Done, Active, Pending});
  see(2.1, 2.05, 2.0, {Done, Done, Active});
  see(2.1, 2.05, 2.0, {Done, Done, Done});
  EXPECT_FALSE(watch_.found());
}

// 0.12 in each of three stretches, which no tolerance of 0.2 shows.
TEST_F(DriftWatchTest, WhenALevelAtRestCreeps_ThenTheSumNamesItsSensor) {
  see(5.0, 2.0, 2.12, {Active, Pending, Pending});
  see(2.0, 5.0, 2.24, {Done, Active, Pending});
  EXPECT_FALSE(watch_.found());
  see(2.0, 2.0, 2.36, {Done, Done, Active});
  const auto found = watch_.found();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->sensor, "S3");
  EXPECT_NEAR(found->amount, 0.36, 1e-9);
  EXPECT_EQ(to_string(*found),
            "a little at a time, level of a2 has come to read 0.36 more than was brought there: sensor S3 "
            "drifts");
}

// What left v1 has not arrived, 0.18 of it; while the customer is served nobody knows; then it goes on.
TEST_F(DriftWatchTest, WhenLessArrivesThanHasLeft_ThenItAddsUpOnBothSidesOfTheHose) {
  see(5.0, 2.0, 2.0, {Active, Pending, Pending});
  see(2.0, 4.82, 2.0, {Done, Active, Pending});
  see(2.0, 1.8, 2.0, {Done, Done, Active});
  EXPECT_FALSE(watch_.found());
  see(2.0, 1.65, 2.0, {Done, Done, Done});
  const auto found = watch_.found();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->sensor, "S2");
  EXPECT_NEAR(found->amount, -0.33, 1e-9);
  EXPECT_NE(to_string(*found).find("a leak, or sensor S2 drifts"), std::string::npos);
}

// The bias of the first stretch is in the second one, too: only what is new counts.
TEST_F(DriftWatchTest, WhenAnActionMovesALevelAlone_ThenThatTellsNothing) {
  see(5.0, 2.0, 2.0, {Done, Active, Pending});
  see(5.0, 0.5, 2.0, {Done, Done, Active});
  see(5.0, 0.5, 2.0, {Done, Done, Done});
  EXPECT_FALSE(watch_.found());
}

TEST_F(DriftWatchTest, WhenALevelHasJumped_ThenTheNextOneHasATolerance) {
  see(5.0, 2.0, 1.2, {Pending, Pending, Active});
  watch_.rest(levels(5.0, 2.0, 1.2));
  EXPECT_FALSE(watch_.found());
  watch_.rest(levels(5.0, 2.0, 1.05));
  EXPECT_FALSE(watch_.found());
  watch_.rest(levels(5.0, 2.0, 0.95));
  const auto found = watch_.found();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->sensor, "S3");
}

TEST_F(DriftWatchTest, WhenAnActionIsInterrupted_ThenWhatItMovedTellsNothing) {
  see(5.0, 2.0, 2.0, {Active, Pending, Pending});
  see(4.0, 2.8, 2.0, {Failed, Pending, Pending});
  watch_.rest(levels(3.9, 2.9, 2.15));
  EXPECT_FALSE(watch_.found());
  watch_.follow(run_);
  see(3.9, 2.9, 2.31, {Active, Pending, Pending});
  ASSERT_TRUE(watch_.found());
  EXPECT_EQ(watch_.found()->sensor, "S3");
}

TEST_F(DriftWatchTest, WhenNobodyWatched_ThenTheSumStaysAndTheLevelsBeginAnew) {
  see(5.0, 2.15, 2.0, {Pending, Pending, Active});
  watch_.forget();
  watch_.rest(levels(5.0, 1.0, 2.0));
  EXPECT_FALSE(watch_.found());
  watch_.rest(levels(5.0, 1.16, 2.0));
  ASSERT_TRUE(watch_.found());
  EXPECT_NEAR(watch_.found()->amount, 0.31, 1e-9);
}

}  // namespace
}  // namespace stepwright::executive
