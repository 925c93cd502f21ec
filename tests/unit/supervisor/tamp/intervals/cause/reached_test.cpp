#include "supervisor/tamp/intervals/cause/reached.h"

#include <gmock/gmock.h>

#include <numbers>
#include <optional>

#include "supervisor/tamp/intervals/arm/srs_exact.h"
#include "supervisor/tamp/intervals/cause/cause.h"
#include "supervisor/tamp/intervals/reach/column_arm.h"
#include "tests/support/tamp/certificate_check.h"
#include "tests/support/tamp/moved_cells.h"
#include "tests/unit/supervisor/motion/kinematics/arms.h"

namespace stepwright::tamp {
namespace {

using ::testing::HasSubstr;

const testing::TwoArms& both_arms() {
  static const testing::TwoArms two = testing::two_arms(0.06);
  return two;
}

// Cells of the experiments, whose arms can be asked.
struct Asked {
  explicit Asked(testing::Problem given)
      : right(both_arms().model(0)), left(both_arms().model(1)), problem(std::move(given)) {
    problem.cell.arms[0].exact = &right;
    problem.cell.arms[1].exact = &left;
  }
  ColumnReach right, left;
  testing::Problem problem;
};

TEST(Reached, WhenAnArmReachesThePlaces_ThenTheWitnessMeetsEveryConstraintAndIsExact) {
  int found = 0, feasible = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Asked asked(testing::experiment_1(both_arms(), seed));
    const auto witness = reached(asked.problem.cell, asked.problem.sequence);
    Network network(asked.problem.cell);
    for (const Action& action : asked.problem.sequence) network.push(action);
    if (solve(network).answer == Answer::Feasible) ++feasible;
    if (!witness) continue;
    ++found;
    EXPECT_EQ(testing::wrong_with(network, *witness), "") << seed;
    for (const Network::Visit& visit : network.visits()) {
      Point3 at = witness->spots[network.places()[visit.place].spot];
      at[2] += visit.rise_nm;
      const Angle tool = witness->angles[network.places()[visit.place].angle] + witness->angles[visit.hand];
      EXPECT_TRUE(
          asked.problem.cell.arms[network.constraints()[visit.constraint].arm].exact->reaches(at, tool))
          << seed;
    }
  }
  EXPECT_GT(found, 20);
  EXPECT_GE(feasible, found);
}

TEST(Reached, WhenNobodyCanBeAsked_ThenNothingIsProved) {
  const testing::Problem problem = testing::experiment_1(both_arms(), 1);
  EXPECT_FALSE(reached(problem.cell, problem.sequence));
}

// What would do, does: the arms reach it, and the tightest bounds that a point has allow it.
TEST(Reached, WhenOneNumberWasMoved_ThenWhatWouldDoIsReached) {
  int proved = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    testing::MovedCell moved = testing::moved_cell(both_arms(), seed);
    const Asked asked(moved.problem);
    const auto cause = explain(asked.problem.cell, asked.problem.sequence);
    ASSERT_TRUE(cause) << seed;
    for (const Suggestion& each : cause->suggestions) {
      if (!each.proved) continue;
      ++proved;
      WorkCell cell = asked.problem.cell;
      std::vector<Action> sequence = asked.problem.sequence;
      apply(each, cell, sequence);
      EXPECT_TRUE(reached(cell, sequence, 100'000)) << seed << ": " << each.text;
    }
  }
  EXPECT_GT(proved, 15);
}

// One pose, out of reach, of the arm of the tree's robot: what is proposed has an inverse kinematics.
TEST(Reached, WhenAPoseOfASevenJointArmIsOutOfReach_ThenProposalsHavePosturesAndBoundsSayAtLeast) {
  const motion::Chain chain = motion::tests::own_arm("right");
  const auto bounds = SrsReach::make(chain);
  const auto exact = SrsExact::make(chain, {});
  ASSERT_TRUE(bounds && exact);
  const ReachTable table = bounds->table(0.04);
  const auto any_angle = [&](double x_m, double y_m, double z_m) {
    const Point3 at{nanometres_of(x_m), nanometres_of(y_m), nanometres_of(z_m)};
    for (int k = 0; k < 360; ++k)
      if (exact->reaches(at, angle_of(k * std::numbers::pi / 180.0))) return true;
    return false;
  };
  WorkCell cell;
  cell.arms = {{"right", &table, &*exact}};
  cell.grasps = {{"top", 0.1, 0.0, {}}};
  cell.objects = {{"can", {0.5, 0.6, 0.71, 0.0}, 0.1}};
  const std::vector<Action> sequence = {pick(0, 0)};
  const auto cause = explain(cell, sequence);
  ASSERT_TRUE(cause);
  ASSERT_FALSE(cause->suggestions.empty());
  bool any = false;
  for (const Suggestion& each : cause->suggestions) {
    if (!each.proved) continue;
    any = true;
    WorkCell changed = cell;
    std::vector<Action> same = sequence;
    apply(each, changed, same);
    const ObjectPose& at = changed.objects[0].start;
    EXPECT_TRUE(any_angle(at.x_m, at.y_m, at.z_m + 0.1)) << each.text;
  }
  EXPECT_TRUE(any);
  EXPECT_THAT(cause->sentence, HasSubstr(" would do"));
  // Without somebody to ask the bounds are all that is known.
  cell.arms[0].exact = nullptr;
  const auto bound = explain(cell, sequence);
  ASSERT_TRUE(bound);
  EXPECT_THAT(bound->sentence, HasSubstr(" is at least "));
  EXPECT_THAT(bound->sentence, HasSubstr("; not before can at "));
}

TEST(Reached, WhenSomebodyElseRefusesAValue_ThenItIsNotProposed) {
  const ColumnArm model;
  const ColumnReach exact(model);
  const ReachTable table = reach_table(model, 0.04);
  WorkCell cell;
  cell.arms = {{"right", &table, &exact}};
  cell.grasps = {{"top", 0.1, 0.0, {}}};
  cell.objects = {{"can", {1.2, 0.0, -0.1, 0.0}, 0.1}};
  const std::vector<Action> sequence = {pick(0, 0)};
  CauseOptions options;
  options.accepts = [](const WorkCell& changed, std::span<const Action>) {
    return changed.objects[0].start.x_m < 0.85;  // there is something in the way
  };
  const auto cause = explain(cell, sequence, options);
  ASSERT_TRUE(cause);
  ASSERT_TRUE(cause->suggestions.front().proved);
  EXPECT_LT(cause->suggestions.front().to, 0.85);
  EXPECT_GT(cause->suggestions.front().to, 0.75);
  options.accepts = [](const WorkCell&, std::span<const Action>) { return false; };
  for (const Suggestion& each : explain(cell, sequence, options)->suggestions) EXPECT_FALSE(each.proved);
}

}  // namespace
}  // namespace stepwright::tamp
