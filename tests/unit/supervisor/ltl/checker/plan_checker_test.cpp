#include "supervisor/ltl/checker/plan_checker.h"

#include <gtest/gtest.h>

#include <limits>

#include "supervisor/ltl/train/train_motion.h"
#include "tests/unit/supervisor/ltl/regions/floors.h"

namespace stepwright::ltl {
namespace {

using testing::Rectangle;

// A train with two trailers that goes ahead for 10 m, and turns left: a bare hall with a place ahead.
struct Drive {
  Drive() {
    floor.border = Rectangle{0, 0, 40, 20}.area("border");
    floor.propositions = {Rectangle{8, 4, 10, 8}.area("press"), Rectangle{30, 15, 32, 17}.area("rack")};
    plan.start = standing_at(model, {5.0, 6.0, 0.0});
    add({1.0, 0.0}, 1.5);
    add({0.0, 0.0}, 3.0);
    add({0.0, 0.5}, 0.6);
    add({0.0, 0.0}, 2.0);
    add({0.0, -0.5}, 0.6);
    finish();
  }
  void add(const TrainControl& control, double duration_s) { plan.pieces.push_back({control, duration_s}); }
  // The end is where these controls lead.
  void finish() {
    TrainMotion motion(model, 1e-10);
    plan.end = plan.start;
    for (const TrainPiece& piece : plan.pieces)
      for (double left = piece.duration_s; left > 1e-12;) left -= motion.step(plan.end, piece.control, left);
  }
  PlanJudgement judged(const std::string& task = "visit press") const {
    const auto formula = parse_formula(task, {}, {"press", "rack"});
    EXPECT_TRUE(formula);
    return judge_plan(floor, model, standing_at(model, {5.0, 6.0, 0.0}), *formula, plan);
  }

  Floor floor;
  TrainModel model{.trailers = 2};
  TrainPlan plan;
};

TEST(PlanChecker, WhenAPlanHolds_ThenItIsAcceptedWithItsWord) {
  const Drive drive;
  const PlanJudgement judgement = drive.judged();
  EXPECT_TRUE(judgement.accepted()) << judgement.reason;
  EXPECT_EQ(judgement.word, (std::vector<Label>{0, 1, 0}));
  EXPECT_NEAR(judgement.duration_s, 7.7, 1e-9);
  EXPECT_NEAR(judgement.length_m, 0.5 * 1.5 * 1.5 + 1.5 * 6.2, 1e-3);
  EXPECT_LT(judgement.end_error, 1e-5);
  EXPECT_GT(judgement.looks, 500u);
}

TEST(PlanChecker, WhenThereIsNoTime_ThenItIsRefused) {
  const Drive drive;
  const auto formula = parse_formula("visit press", {}, {"press", "rack"});
  std::size_t asked = 0;
  const PlanCheckerOptions options{.stop = [&] { return ++asked == 3; }};
  const PlanJudgement judgement =
      judge_plan(drive.floor, drive.model, drive.plan.start, *formula, drive.plan, options);
  EXPECT_EQ(judgement.reason, "there was no time to judge it");
  EXPECT_EQ(asked, 3u);
}

TEST(PlanChecker, WhenAPlanJumps_ThenItIsRefused) {
  Drive begins;
  begins.plan.start[kTrainX] += 0.5;
  begins.finish();
  EXPECT_EQ(begins.judged().reason, "the plan begins elsewhere");
  Drive skips;
  skips.plan.pieces.erase(skips.plan.pieces.begin() + 1);
  EXPECT_EQ(skips.judged().reason, "the plan ends elsewhere");
}

TEST(PlanChecker, WhenTheEndIsWrong_ThenItIsRefusedWhateverStateItIs) {
  for (std::size_t k = 0; k < 7; ++k) {
    Drive drive;
    drive.plan.end[k] += 0.01;
    EXPECT_EQ(drive.judged().reason, "the plan ends elsewhere") << k;
    drive.plan.end[k] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(drive.judged().reason, "the plan ends elsewhere") << k;
  }
}

TEST(PlanChecker, WhenControlsOrTimesAreBeyondTheirLimits_ThenItIsRefused) {
  Drive strong;
  strong.plan.pieces[0].control.acceleration_m_s2 = 1.2;
  EXPECT_EQ(strong.judged().reason, "a control is beyond its limits");
  strong.plan.pieces[0].control.acceleration_m_s2 = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(strong.judged().reason, "a control is beyond its limits");
  for (const double duration_s : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    Drive drive;
    drive.plan.pieces[1].duration_s = duration_s;
    EXPECT_EQ(drive.judged().reason, "a control lasts no time");
  }
  Drive endless;
  endless.plan.pieces[1].duration_s = std::numeric_limits<double>::infinity();
  EXPECT_EQ(endless.judged().reason, "the plan lasts too long");
}

TEST(PlanChecker, WhenItIsTooFastOrSteersTooFar_ThenItIsRefused) {
  Drive fast;
  fast.plan.pieces[0].duration_s = 2.5;  // at 1 m/s^2: beyond 2 m/s in this piece
  EXPECT_EQ(fast.judged().reason.substr(0, 8), "too fast");
  Drive far;
  far.plan.pieces[2].duration_s = 2.5;
  EXPECT_EQ(far.judged().reason.substr(0, 14), "steers too far");
}

TEST(PlanChecker, WhenTheTractorMeetsSomething_ThenItIsRefused) {
  Drive drive;
  drive.floor.obstacles = {{"post", {{7.0, 6.0}, {7.1, 6.0}, {7.05, 6.1}}, {}}};  // within one box at last
  EXPECT_EQ(drive.judged().reason.substr(0, 19), "link 0 meets 'post'");
  Drive leaves;
  leaves.floor.border = Rectangle{0, 0, 9, 20}.area("border");
  EXPECT_EQ(leaves.judged().reason.substr(0, 23), "link 0 leaves the floor");
}

TEST(PlanChecker, WhenATrailerMeetsSomething_ThenItIsRefused) {
  // Where the tractor turns left its trailers cut the corner: a post there is met by the second of them only.
  Drive drive;
  drive.plan.pieces.resize(2);
  drive.add({0.0, 1.0}, 0.5);
  drive.add({0.0, 0.0}, 2.6);
  drive.finish();
  ASSERT_TRUE(drive.judged().accepted()) << drive.judged().reason;
  for (const double x : {10.35, 10.4, 10.45, 10.5}) {
    drive.floor.obstacles = {{"post", {{x, 6.3}, {x + 0.02, 6.3}, {x, 6.32}}, {}}};
    EXPECT_EQ(drive.judged().reason.substr(0, 19), "link 2 meets 'post'") << x;
  }
}

TEST(PlanChecker, WhenLinksMeetEachOther_ThenItIsRefused) {
  Drive drive;
  drive.model = {.trailers = 6, .hitch_m = 0.5, .length_m = 0.95, .width_m = 0.9};
  drive.plan.start = standing_at(drive.model, {5.0, 6.0, 0.0});
  drive.floor.border = {"border", {{-20, -20}, {40, -20}, {40, 40}, {-20, 40}}, {}};
  drive.plan.pieces.clear();
  drive.add({1.0, 1.0}, 1.0);
  drive.add({0.0, 0.0}, 12.0);  // round and round, on a circle that is shorter than the train
  drive.finish();
  const std::string reason = drive.judged("visit press | true").reason;
  EXPECT_EQ(reason.substr(0, 6), "links ") << reason;
}

TEST(PlanChecker, WhenTheFormulaIsViolated_ThenItIsRefused) {
  EXPECT_EQ(Drive().judged("visit rack").reason, "the way does not satisfy the task");
  EXPECT_EQ(Drive().judged("!press U rack").reason, "the way does not satisfy the task");
  EXPECT_TRUE(Drive().judged("!rack U press").accepted());
}

TEST(PlanChecker, WhenThereAreNoControls_ThenTheStartIsJudged) {
  Drive drive;
  drive.plan.pieces.clear();
  drive.plan.end = drive.plan.start;
  EXPECT_EQ(drive.judged().reason, "the way does not satisfy the task");
  EXPECT_TRUE(drive.judged("true").accepted());
  drive.floor.obstacles = {Rectangle{4, 5, 6, 7}.area("block")};  // around the tractor
  EXPECT_EQ(drive.judged("true").reason.substr(0, 20), "link 0 meets 'block'");
}

}  // namespace
}  // namespace stepwright::ltl
