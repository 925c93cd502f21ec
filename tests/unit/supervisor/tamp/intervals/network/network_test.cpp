#include "supervisor/tamp/intervals/network/network.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/tamp/certificate_check.h"
#include "tests/support/tamp/experiments.h"

namespace stepwright::tamp {
namespace {

using testing::kLeft;
using testing::kRight;
using testing::TwoArms;

constexpr double kPi = std::numbers::pi;

const TwoArms& arms() {
  static const TwoArms two = testing::two_arms(0.05);
  return two;
}

// The numbers of the paper: a cup at (0.6, 0.25, 0.1), grasped from 0.34 m above it, where the map says that
// the hand can be turned from -0.70 to 2.36.
TEST(Network, WhenThePapersCupIsPicked_ThenTheToolIsWhereThePaperSays) {
  const ReachGrid grid{{0, 0, 0}, {100'000'000, 100'000'000, 100'000'000}, {10, 10, 10}};
  const ReachTable map = ReachTable::fill(grid, [](const Box& cell) {
    return cell[0].contains(600'000'000) && cell[1].contains(250'000'000)
               ? ArcSet::of(arc_outward(-0.70, 2.36))
               : ArcSet::of(arc_outward(-2.0, 3.0));
  });
  WorkCell cell;
  cell.arms = {{"right", &map}};
  cell.grasps = {{"top", 0.34, 0.0, {}}};
  cell.objects = {{"cup", {0.6, 0.25, 0.1, 0.0}, 0.1}};
  Network network(cell);
  ASSERT_TRUE(network.push(pick(0, 0)));
  const Network::Visit& visit = network.visits()[0];
  const Box box = network.box(network.places()[visit.place].spot);
  EXPECT_EQ(box[0], (Span{600'000'000, 600'000'000}));
  EXPECT_EQ(box[1], (Span{250'000'000, 250'000'000}));
  EXPECT_EQ(box[2].low_nm + visit.rise_nm, 440'000'000) << "of the tool: exact, without rounding";
  const ArcSet tool =
      sum_of(network.angle(network.places()[visit.place].angle).arcs(), network.angle(visit.hand).arcs());
  ASSERT_EQ(tool.size(), 1u);
  EXPECT_NEAR(radians_of(tool.arcs()[0].low), -0.70, 5e-9);
  EXPECT_NEAR(radians_of(tool.arcs()[0].high()), 2.36, 5e-9);
}

WorkCell one_cup(const ObjectPose& at) {
  WorkCell cell;
  cell.arms = {{"right", &arms().right_table}, {"left", &arms().left_table}};
  cell.grasps = {{"top", 0.34, 0.0, {}}, {"handle", 0.34, 0.0, {{-0.2, 0.2}}}, {"beside", 0.34, 0.03, {}}};
  cell.regions = {{"tray1", 0.5, -0.2, 0.05, 0.3, 0.3, 0.0}, {"far", 1.5, 0.0, 0.05, 0.3, 0.3, 0.0}};
  cell.objects = {{"cup1", at, 0.1}, {"cup2", {0.45, -0.1, 0.05, 0.0}, 0.1}};
  return cell;
}

TEST(Network, WhenATransferTurnsTooFar_ThenItIsRefutedAndOtherwiseNot) {
  const WorkCell cell = one_cup({0.5, -0.3, 0.05, 0.0});
  const auto place_at = [&](double final_rad) {
    Network network(cell);
    return network.push(pick(kRight, 0)) && network.push(place(kRight, 0, 0, final_rad));
  };
  EXPECT_TRUE(place_at(0.0));
  EXPECT_TRUE(place_at(2.0));
  EXPECT_TRUE(place_at(-2.0 + 2.0 * kPi)) << "an angle is the same on any turn";
  // The hand turns by 1.2 to both sides, and a little more with its direction.
  Network network(cell);
  network.push(pick(kRight, 0));
  EXPECT_FALSE(network.push(place(kRight, 0, 1, 0.0))) << "too far";
  EXPECT_EQ(testing::wrong_with(network, network.certificate()), "");
}

TEST(Network, WhenAGraspAllowsSomeAnglesOnly_ThenTheHandHasNoOthers) {
  const WorkCell cell = one_cup({0.5, -0.3, 0.05, 0.3});
  Network network(cell);
  ASSERT_TRUE(network.push(pick(kRight, 0, 1)));
  const ArcSet& hand = network.angle(network.handlings()[0].hand);
  EXPECT_TRUE(hand.contains(angle_of(0.19)) && hand.contains(angle_of(-0.19)));
  EXPECT_FALSE(hand.contains(angle_of(0.21)));
}

TEST(Network, WhenAGraspIsBesideTheAxis_ThenItReachesAtLeastAsMuch) {
  for (double x_m = 0.3; x_m < 0.95; x_m += 0.01) {
    const WorkCell cell = one_cup({x_m, -0.3, 0.05, 0.3});
    Network top(cell), beside(cell);
    const bool reached = top.push(pick(kRight, 0, 0)), perhaps = beside.push(pick(kRight, 0, 2));
    EXPECT_TRUE(perhaps || !reached) << x_m;
    if (!reached || !perhaps) continue;
    for (const Arc arc : top.angle(top.handlings()[0].hand).arcs())
      EXPECT_TRUE(beside.angle(beside.handlings()[0].hand).contains(arc)) << x_m;
  }
}

TEST(Network, WhenAnActionIsPopped_ThenAllIsAsBefore) {
  const testing::Problem problem = testing::experiment_1(arms(), 3);
  Network network(problem.cell), plain(problem.cell);
  network.push(problem.sequence[0]);
  plain.push(problem.sequence[0]);
  for (int k = 0; k < 3; ++k) {
    for (std::size_t a = 1; a < problem.sequence.size(); ++a) network.push(problem.sequence[a]);
    for (std::size_t a = 1; a < problem.sequence.size(); ++a) network.pop();
  }
  ASSERT_EQ(network.angles(), plain.angles());
  ASSERT_EQ(network.spots(), plain.spots());
  ASSERT_EQ(network.constraints().size(), plain.constraints().size());
  for (AngleId k = 0; k < plain.angles(); ++k) EXPECT_EQ(network.angle(k), plain.angle(k));
  for (std::uint32_t s = 0; s < plain.spots(); ++s) EXPECT_EQ(network.box(s), plain.box(s));
  // And goes on like a new one.
  for (std::size_t a = 1; a < problem.sequence.size(); ++a)
    EXPECT_EQ(network.push(problem.sequence[a]), plain.push(problem.sequence[a]));
  for (AngleId k = 0; k < plain.angles(); ++k) EXPECT_EQ(network.angle(k), plain.angle(k));
}

TEST(Network, WhenItWasRefuted_ThenFurtherActionsChangeNothingUntilItIsPopped) {
  const WorkCell cell = one_cup({0.5, -0.3, 0.05, 0.0});
  Network network(cell);
  network.push(pick(kRight, 0));
  EXPECT_FALSE(network.push(place(kRight, 0, 1)));
  EXPECT_FALSE(network.push(pick(kRight, 0)));
  network.pop();
  EXPECT_TRUE(network.refuted());
  EXPECT_EQ(testing::wrong_with(network, network.certificate()), "");
  network.pop();
  EXPECT_FALSE(network.refuted());
  EXPECT_TRUE(network.push(place(kRight, 0, 0)));
}

TEST(Network, WhenProblemsAreRandom_ThenEachRefutationIsProvedStepByStep) {
  int refuted = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    for (const bool both : {false, true}) {
      const testing::Problem problem =
          both ? testing::experiment_2(arms(), seed) : testing::experiment_1(arms(), seed);
      Network network(problem.cell);
      for (const Action& action : problem.sequence)
        if (!network.push(action)) break;
      if (!network.refuted()) continue;
      ++refuted;
      EXPECT_EQ(testing::wrong_with(network, network.certificate()), "") << seed << both;
    }
  }
  EXPECT_GT(refuted, 10);
}

TEST(Network, WhenACertificateIsTamperedWith_ThenTheCheckTells) {
  const WorkCell cell = one_cup({0.5, -0.3, 0.05, 0.0});
  Network network(cell);
  network.push(pick(kRight, 0));
  ASSERT_FALSE(network.push(place(kRight, 0, 1)));
  Certificate without = network.certificate();
  ASSERT_GT(without.steps.size(), 1u);
  without.steps.erase(without.steps.begin());
  EXPECT_NE(testing::wrong_with(network, without), "");
  Certificate open = network.certificate();
  open.steps.pop_back();
  EXPECT_NE(testing::wrong_with(network, open), "");
  Certificate narrow = network.certificate();
  for (Step& step : narrow.steps)
    if (step.kind == StepKind::Given && !step.is_angle) step.span.low_nm = step.span.high_nm + 5;
  EXPECT_NE(testing::wrong_with(network, narrow), "");
}

// Four cups on top of each other in reach: where the first one may stand is a part of the table (Fig. 2).
TEST(Network, WhenCupsAreStacked_ThenTheFirstOneIsHeldToWhereTheLastOneIsReached) {
  WorkCell cell = one_cup({0.5, -0.3, 0.05, 0.0});
  cell.regions = {{"square", 0.64, -0.25, 0.26, 0.3, 0.3, 0.0}};
  cell.objects.clear();
  for (int k = 0; k < 4; ++k)
    cell.objects.push_back({"cup" + std::to_string(k + 1), {0.4, -0.45 + 0.1 * k, 0.05, 0.0}, 0.1});
  Network network(cell);
  ASSERT_TRUE(network.push(pick(kRight, 0)));
  ASSERT_TRUE(network.push(place(kRight, 0, 0)));
  const std::uint32_t spot = network.places()[network.handlings()[1].place].spot;
  const Box alone = network.box(spot);
  for (std::size_t k = 1; k < 4; ++k) {
    ASSERT_TRUE(network.push(pick(kRight, k)));
    ASSERT_TRUE(network.push(stack(kRight, k, k - 1)));
  }
  const Box all = network.box(spot);
  EXPECT_EQ(network.places()[network.handlings()[7].place].spot, spot);
  EXPECT_EQ(network.places()[network.handlings()[7].place].rise_nm, 300'000'000);
  EXPECT_LT(all[0].high_nm, alone[0].high_nm) << "nearer to the robot";
  EXPECT_GE(all[0].low_nm, alone[0].low_nm);
}

}  // namespace
}  // namespace stepwright::tamp
