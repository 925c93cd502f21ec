#include "supervisor/tamp/intervals/cause/cause.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <numbers>

#include "supervisor/tamp/intervals/cause/witness.h"
#include "tests/support/tamp/certificate_check.h"
#include "tests/support/tamp/moved_cells.h"

namespace stepwright::tamp {
namespace {

using ::testing::HasSubstr;
using testing::kRight;

constexpr double kPi = std::numbers::pi;

const testing::TwoArms& arms() {
  static const testing::TwoArms two = testing::two_arms(0.06);
  return two;
}

// Only these constraints count.
Network only(const WorkCell& cell, const std::vector<Action>& sequence, const std::vector<ConstraintId>& ids,
             std::vector<bool>& dropped) {
  Network whole(cell);
  for (const Action& action : sequence) whole.push(action);
  dropped.assign(whole.constraints().size(), true);
  for (const ConstraintId id : ids) dropped[id] = false;
  Network network(cell, {.dropped = dropped});
  for (const Action& action : sequence) network.push(action);
  return network;
}

TEST(Solve, WhenProblemsAreRandom_ThenWitnessesMeetEveryConstraint) {
  int feasible = 0, infeasible = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    for (const bool both : {false, true}) {
      const testing::Problem problem =
          both ? testing::experiment_2(arms(), seed) : testing::experiment_1(arms(), seed);
      Network network(problem.cell);
      for (const Action& action : problem.sequence) network.push(action);
      const Solution solution = solve(network);
      ASSERT_NE(solution.answer, Answer::Unknown) << seed << both;
      EXPECT_EQ(solution.answer == Answer::Infeasible, network.refuted())
          << seed << both << ": propagation alone decides a chain of places";
      ++(solution.witness ? feasible : infeasible);
      if (!solution.witness) continue;
      EXPECT_EQ(testing::wrong_with(network, *solution.witness), "") << seed << both;
    }
  }
  EXPECT_GT(feasible, 20);
  EXPECT_GT(infeasible, 5);
}

TEST(Cause, WhenATrayIsTooHigh_ThenItSaysByHowMuchAndForWhom) {
  WorkCell cell;
  cell.arms = {{"right", &arms().right_table}};
  cell.grasps = {{"top", 0.34, 0.0, {}}};
  cell.regions = {{"tray1", 0.4, -0.25, 0.925, 0.3, 0.2, 0.0}};
  cell.objects = {{"cup1", {0.5, -0.27, 0.05, 0.0}, 0.1}};
  std::vector<Action> sequence = {pick(kRight, 0), place(kRight, 0, 0, kPi * 94.0 / 180.0)};
  const auto cause = explain(cell, sequence);
  ASSERT_TRUE(cause);
  EXPECT_TRUE(cause->irreducible);
  EXPECT_THAT(cause->sentence, HasSubstr("tray1 is "));
  EXPECT_THAT(cause->sentence, HasSubstr(" mm too high for the right arm"));
  EXPECT_THAT(cause->sentence, HasSubstr("this final angle of cup1"));
  EXPECT_THAT(cause->sentence, HasSubstr("tray1 at a height of 0."));
  ASSERT_FALSE(cause->suggestions.empty());
  const Suggestion& first = cause->suggestions.front();
  EXPECT_EQ(first.parameter, Parameter::RegionHeight);
  // It is the nearest one: 0.2 mm above, the sequence is refuted again.
  WorkCell higher = cell;
  apply(first, higher, sequence);
  EXPECT_EQ(solve(higher, sequence).answer, Answer::Feasible);
  higher.regions[0].z_m += 0.0002;
  EXPECT_EQ(solve(higher, sequence).answer, Answer::Infeasible);
}

TEST(Cause, WhenAnAngleIsOutOfReach_ThenTheNearestOneIsNamed) {
  WorkCell cell;
  cell.arms = {{"right", &arms().right_table}};
  cell.grasps = {{"handle", 0.34, 0.0, {{-0.1, 0.1}}}};
  cell.regions = {{"tray1", 0.5, -0.25, 0.05, 0.1, 0.1, 0.0}};
  cell.objects = {{"cup1", {0.5, -0.3, 0.05, 0.0}, 0.1}};
  std::vector<Action> sequence = {pick(kRight, 0), place(kRight, 0, 0, kPi)};
  const auto cause = explain(cell, sequence);
  ASSERT_TRUE(cause);
  const auto angle = std::ranges::find(cause->suggestions, Parameter::FinalAngle, &Suggestion::parameter);
  ASSERT_NE(angle, cause->suggestions.end());
  EXPECT_THAT(angle->text, HasSubstr(" deg at the end"));
  apply(*angle, cell, sequence);
  EXPECT_EQ(solve(cell, sequence).answer, Answer::Feasible);
  EXPECT_FALSE(explain(cell, sequence)) << "nothing is wrong any more";
  EXPECT_EQ(text_of(cell, sequence, cause->constraints.front()).empty(), false);
}

// 200 cells, each feasible until one number of it was moved.
TEST(Cause, WhenOneNumberWasMoved_ThenItIsInTheSetWhichIsMinimalAndTheValueDoes) {
  std::size_t without_value = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const testing::MovedCell moved = testing::moved_cell(arms(), seed);
    const std::vector<Action>& sequence = moved.problem.sequence;
    const auto cause = explain(moved.problem.cell, sequence);
    ASSERT_TRUE(cause) << seed;
    EXPECT_TRUE(cause->irreducible) << seed;
    EXPECT_TRUE(std::ranges::any_of(cause->constraints,
                                    [&](const Constraint& each) { return testing::fixes(each, moved); }))
        << seed << ": " << cause->sentence;
    std::vector<bool> dropped;
    const Network conflict = only(moved.problem.cell, sequence, cause->ids, dropped);
    ASSERT_TRUE(conflict.refuted()) << seed;
    for (const ConstraintId id : cause->ids) {
      std::vector<ConstraintId> others = cause->ids;
      std::erase(others, id);
      Network rest = only(moved.problem.cell, sequence, others, dropped);
      const Solution solution = solve(rest);
      ASSERT_TRUE(solution.witness) << seed << ": not minimal: "
                                    << text_of(moved.problem.cell, sequence, conflict.constraints()[id]);
      EXPECT_EQ(testing::wrong_with(rest, *solution.witness, dropped), "") << seed;
    }
    bool has_value = false;
    for (const Suggestion& suggestion : cause->suggestions) {
      WorkCell cell = moved.problem.cell;
      std::vector<Action> changed = sequence;
      apply(suggestion, cell, changed);
      EXPECT_EQ(solve(cell, changed).answer, Answer::Feasible) << seed << ": " << suggestion.text;
      if (suggestion.parameter != moved.parameter || suggestion.subject != moved.subject) continue;
      has_value = true;
      if (moved.is_angle()) continue;
      // No further away than the value that it had.
      EXPECT_LE(std::abs(suggestion.to - suggestion.from), std::abs(moved.before - suggestion.from) + 1.1e-4)
          << seed;
    }
    if (!has_value) ++without_value;
  }
  EXPECT_EQ(without_value, 0u);
}

}  // namespace
}  // namespace stepwright::tamp
