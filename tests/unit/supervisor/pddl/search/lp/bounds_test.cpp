// Bounds against the truth: on every reachable state of small tasks, no bound is above what is really left,
// and nothing that says "no plan from here" is wrong.

#include <gtest/gtest.h>

#include <map>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/search/bounds/landmark_cut.h"
#include "supervisor/pddl/search/bounds/lower_bounds.h"
#include "supervisor/pddl/search/lp/lp_bound.h"
#include "supervisor/pddl/search/relaxation/additive_heuristic.h"
#include "supervisor/pddl/search/relaxation/relaxed_plan.h"
#include "tests/support/pddl/random_task.h"
#include "tests/support/pddl/sample_tasks.h"
#include "tests/support/pddl/true_distances.h"

namespace stepwright::pddl {
namespace {

struct Tally {
  int states = 0;
  int dead = 0;       // no plan from there
  int informed = 0;   // the cut bound is above zero
  int programs = 0;   // the linear program's bound is above the cut bound
  int exact = 0;      // the linear program's bound is the truth, above zero
  int seen_dead = 0;  // dead states that the linear program knows
};

// Bounds by linear programming, of costs and of steps, with more and more effort.
void judge_program(LpBound& program, const testing::StateDistance& truth, double cut_bound, Tally& tally) {
  const Word* state = truth.state.data();
  for (const int rounds : {0, 1, 4}) {
    const double bound = program.cost(state, {.rounds = rounds});
    ASSERT_LE(bound, truth.cost + 1e-6);
    ASSERT_LE(program.steps(state, truth.cost, {.rounds = rounds}), truth.steps_of_cheapest);
    ASSERT_LE(program.steps(state, 1e6, {.rounds = rounds}), truth.steps);
    if (rounds < 4) continue;
    tally.programs += bound > cut_bound + 1e-6 ? 1 : 0;
    tally.exact += bound > 0.0 && bound < kInfinity && bound >= truth.cost - 1e-6 ? 1 : 0;
    tally.seen_dead += bound == kInfinity ? 1 : 0;
  }
}

// The bounds of plans that apply an operator, which are read off the last bounds of the state.
void judge_through(const StateSpace& space, const LandmarkCut& cut, const LpBound& program, const Word* state,
                   const std::map<std::vector<Word>, double>& distance) {
  std::vector<Word> next(space.words());
  for (std::size_t i = 0; i < space.task().operators.size(); ++i) {
    const GroundOperator& op = space.task().operators[i];
    double cost = 0.0;
    if (!space.holds(op.precondition, state) || !space.apply(op, state, next.data(), cost)) continue;
    const double truth = cut.costs()[i] + distance.at(next);
    ASSERT_LE(cut.cost_through(static_cast<int>(i)), truth + 1e-6);
    ASSERT_LE(program.cost_through(static_cast<int>(i)), truth + 1e-6);
  }
}

void judge(const Task& task, Tally& tally) {
  GroundTask ground = ground_task(task.definition(), [] { return false; });
  if (ground.unreachable_goal) return;
  arrange_by_groups(ground);
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  const LowerBounds projections(space, [] { return false; });
  LandmarkCut cut(relaxed);
  LpBound program(relaxed, [] { return false; });
  AdditiveHeuristic additive(relaxed, unit_weights(ground));
  RelaxedPlan intervals(space);
  const std::vector<testing::StateDistance> truths = testing::true_distances(space, 30'000);
  std::map<std::vector<Word>, double> distance;
  for (const testing::StateDistance& truth : truths) distance.emplace(truth.state, truth.cost);
  for (const testing::StateDistance& truth : truths) {
    const Word* state = truth.state.data();
    const LowerBound bound = projections(state);
    const double cut_bound = cut(state);
    ASSERT_LE(bound.cost, truth.cost + 1e-9);
    ASSERT_LE(cut_bound, truth.cost + 1e-9);
    if (bound.cost < kInfinity) {
      ASSERT_LE(bound.steps, truth.steps);
    }
    judge_program(program, truth, cut_bound, tally);
    if (bound.cost < kInfinity && cut_bound < kInfinity) {
      judge_through(space, cut, program, truth.state.data(), distance);
    }
    if (::testing::Test::HasFatalFailure()) return;
    ++tally.states;
    tally.informed += cut_bound > 0.0 ? 1 : 0;
    if (truth.steps == kInfinity) {
      ++tally.dead;
      continue;
    }
    ASSERT_TRUE(additive.evaluate(state));
    ASSERT_TRUE(intervals.evaluate(state));
    EXPECT_EQ(additive.estimate() == 0, space.goal(state));
  }
}

class RandomBounds : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(RandomBounds, WhenOnAnyReachableState_ThenNeverAboveTheTruth) {
  Tally tally;
  for (std::uint32_t i = 0; i < 12; ++i) {
    const testing::RandomTask random = testing::random_task(GetParam() * 500 + i);
    SCOPED_TRACE(random.domain + random.problem);
    judge(random.task, tally);
  }
  EXPECT_GT(tally.states, 100);
}

TEST_P(RandomBounds, WhenNumbersAndDerivedFactsArePartOfTheGoal_ThenNeverAboveTheTruthAndNotBlind) {
  Tally tally;
  for (std::uint32_t i = 0; i < 12; ++i) {
    const testing::RandomTask random = testing::random_numeric_task(GetParam() * 500 + i);
    SCOPED_TRACE(random.domain + random.problem);
    judge(random.task, tally);
  }
  EXPECT_GT(tally.states, 200);
  EXPECT_GT(tally.informed, 50);
  EXPECT_GT(tally.programs, 10);
  EXPECT_GT(tally.exact, 5);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomBounds, ::testing::Range(1u, 7u));

TEST(Bounds, WhenOnAnyStateOfSampleTasks_ThenNeverAboveTheTruthAndNotBlind) {
  Tally tally;
  judge(testing::logistics_task(5), tally);
  judge(testing::lamps_task("(and (forall (?l - lamp) (on ?l)) (powered))"), tally);
  judge(testing::counter_task("(= (n) 10)"), tally);
  EXPECT_GT(tally.informed, 50);
}

// Unary operators on a chain: the cut bound is exact there.
TEST(LandmarkCut, WhenEveryStepIsNeeded_ThenItCountsThemAll) {
  const Task task = testing::make_task(
      R"((define (domain d) (:requirements :strips) (:predicates (a) (b) (c) (d))
    (:action one :parameters () :precondition (a) :effect (b))
    (:action two :parameters () :precondition (b) :effect (c))
    (:action three :parameters () :precondition (and (b) (c)) :effect (d))))",
      "(define (problem p) (:domain d) (:init (a)) (:goal (and (b) (d))))");
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  LandmarkCut cut(relaxed);
  EXPECT_EQ(cut(space.initial().data()), 3.0);
}

}  // namespace
}  // namespace stepwright::pddl
