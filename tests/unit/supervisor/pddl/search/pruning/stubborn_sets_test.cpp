// Partial-order reduction: which operators get in each other's way, and that one order out of many is kept,
// judged by the distances of all reachable states and by enumeration.

#include "supervisor/pddl/search/pruning/stubborn_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <string>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/search/engines/astar_search.h"
#include "tests/support/pddl/exhaustive.h"
#include "tests/support/pddl/random_task.h"
#include "tests/support/pddl/sample_tasks.h"
#include "tests/support/pddl/true_distances.h"

namespace stepwright::pddl {
namespace {

using namespace std::chrono_literals;

GroundTask ground_of(const Task& task) {
  GroundTask ground = ground_task(task.definition(), [] { return false; });
  arrange_by_groups(ground);
  return ground;
}

struct Tally {
  std::size_t met = 0, kept = 0;
};

// In every state from which there is a plan, some cheapest one, and among those the shortest, begins with an
// operator that is kept.
void judge_states(const GroundTask& ground, Tally& tally) {
  const StateSpace space(ground);
  StubbornSets stubborn(space);
  std::map<std::vector<Word>, testing::StateDistance> truths;
  for (testing::StateDistance& truth : testing::true_distances(space, 30'000)) {
    truths.emplace(truth.state, truth);
  }
  std::vector<int> applicable;
  std::vector<Word> next(space.words());
  for (const auto& [state, truth] : truths) {
    space.applicable(state.data(), applicable);
    tally.met += applicable.size();
    stubborn.prune(state.data(), applicable);
    tally.kept += applicable.size();
    if (truth.cost == kInfinity || space.goal(state.data())) continue;
    bool begins = false;
    for (const int op : applicable) {
      double cost = 0.0;
      if (!space.apply(op, state.data(), next.data(), cost)) continue;
      const testing::StateDistance& rest = truths.at(next);
      begins = begins || (snap(rest.cost + cost) == snap(truth.cost) &&
                          rest.steps_of_cheapest + 1 == truth.steps_of_cheapest);
    }
    ASSERT_TRUE(begins);
  }
}

// A* on its own, without a plan to begin with.
void judge_search(const Task& task, const GroundTask& ground) {
  const auto optimum = testing::exhaustive_optimum(task, 20'000);
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  LandmarkCut cut(relaxed);
  SearchControl control(0ms, 0, nullptr);
  const LowerBounds bounds(space, [] { return false; });
  AStarSearch search(space, control, bounds, {.cut = &cut});
  StopReason reason = StopReason::None;
  ASSERT_EQ(search.run(UINT64_MAX, reason), SearchStatus::Exhausted);
  ASSERT_EQ(control.best().quality.found(), optimum.has_value());
  if (!optimum) return;
  EXPECT_EQ(snap(control.best().quality.cost + ground.base_cost), optimum->cost);
  EXPECT_EQ(control.best().quality.steps, optimum->steps);
}

// Many actions over few facts and one number: most pairs get in each other's way, each in its own fashion.
testing::RandomTask random_tangle(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto pick = [&](int count) { return static_cast<int>(random() % static_cast<std::uint32_t>(count)); };
  const auto literal = [&] {
    const std::string fact = "(f" + std::to_string(pick(5)) + ")";
    return pick(3) == 0 ? "(not " + fact + ")" : fact;
  };
  std::string domain =
      "(define (domain d) (:requirements :adl :numeric-fluents) (:predicates (f0)(f1)(f2)(f3)(f4)) "
      "(:functions "
      "(x) (cost))";
  for (int a = 0; a < 7; ++a) {
    const std::string x = std::to_string(1 + pick(2));
    static const char* asks[] = {"(>= (x) ", "(<= (x) ", "(= (x) ", "(> (x) "};
    std::string precondition, effect = literal();
    if (pick(2) == 0) precondition += literal();
    if (pick(4) == 0) precondition += "(or " + literal() + literal() + ")";
    if (pick(2) == 0) precondition += asks[pick(4)] + x + ")";
    const int change = pick(5);
    if (change == 0) precondition += "(<= (x) 3)";
    if (change == 0) effect += "(increase (x) " + x + ")";
    if (change == 1) precondition += "(>= (x) " + x + ")";
    if (change == 1) effect += "(decrease (x) " + x + ")";
    if (change == 2) effect += "(assign (x) " + x + ")";
    if (pick(4) == 0) effect += "(when " + literal() + " " + literal() + ")";
    effect += "(increase (cost) " + std::string(pick(4) == 0 ? "(x)" : std::to_string(pick(3))) + ")";
    domain += "(:action a" + std::to_string(a) + " :parameters () :precondition (and " + precondition +
              ") :effect (and " + effect + "))";
  }
  domain += ")";
  const std::string problem =
      "(define (problem p) (:domain d) (:init (f0) (= (x) 2) (= (cost) 0)) (:goal (and (f1) " + literal() +
      literal() + (pick(2) == 0 ? "(>= (x) 2)" : "") + ")) (:metric minimize (cost)))";
  return {domain, problem, testing::make_task(domain, problem)};
}

class RandomReduction : public ::testing::TestWithParam<std::uint32_t> {
 protected:
  void judge(testing::RandomTask (*make)(std::uint32_t), Tally& tally, std::uint32_t count = 25) {
    for (std::uint32_t i = 0; i < count; ++i) {
      const testing::RandomTask random = make(GetParam() * 700 + i);
      SCOPED_TRACE(random.domain + random.problem);
      const GroundTask ground = ground_of(random.task);
      if (ground.unreachable_goal) continue;
      judge_search(random.task, ground);
      judge_states(ground, tally);
      if (::testing::Test::HasFailure()) return;
    }
  }
};

TEST_P(RandomReduction, WhenThingsAreMovedWithFuel_ThenAShortestCheapestPlanIsLeft) {
  Tally tally;
  judge(testing::random_transport_task, tally);
  EXPECT_LT(tally.kept + 100, tally.met);
}

TEST_P(RandomReduction, WhenConditionsAndEffectsAreOfAllKinds_ThenAShortestCheapestPlanIsLeft) {
  Tally tally;
  judge(testing::random_task, tally);
  judge(testing::random_numeric_task, tally);
}

TEST_P(RandomReduction, WhenActionsGetInEachOthersWay_ThenAShortestCheapestPlanIsLeft) {
  Tally tally;
  judge(random_tangle, tally, 150);
  EXPECT_LT(tally.kept + 100, tally.met);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomReduction, ::testing::Range(1u, 9u));

// Switches that have nothing to do with each other.
Task switches_task(int count) {
  std::string predicates, actions, goal;
  for (int i = 0; i < count; ++i) {
    const std::string fact = "(f" + std::to_string(i) + ")";
    predicates += fact;
    goal += fact;
    actions += "(:action a" + std::to_string(i) + " :parameters () :precondition (not " + fact +
               ") :effect " + fact + ")";
  }
  return testing::make_task("(define (domain d) (:requirements :negative-preconditions) (:predicates " +
                                predicates + ")" + actions + ")",
                            "(define (problem p) (:domain d) (:init) (:goal (and " + goal + ")))");
}

TEST(StubbornSets, WhenNothingInterferes_ThenOneOperatorIsLeft) {
  const Task task = switches_task(10);
  const GroundTask ground = ground_of(task);
  const StateSpace space(ground);
  StubbornSets stubborn(space);
  std::vector<int> applicable;
  space.applicable(space.initial().data(), applicable);
  ASSERT_EQ(applicable.size(), 10u);
  stubborn.prune(space.initial().data(), applicable);
  EXPECT_EQ(applicable.size(), 1u);
}

std::size_t kept_of_two(const std::string& first, const std::string& second) {
  const Task task = testing::make_task(
      "(define (domain d) (:requirements :adl :numeric-fluents) (:predicates (p) (q) (r)) (:functions (x) "
      "(cost))"
      "(:action one :parameters () " +
          first + ")(:action two :parameters () " + second + "))",
      "(define (problem p) (:domain d) (:init (r) (= (x) 4) (= (cost) 0)) (:goal (and (p) (q))) (:metric "
      "minimize "
      "(cost)))");
  const GroundTask ground = ground_of(task);
  const StateSpace space(ground);
  StubbornSets stubborn(space);
  std::vector<int> applicable;
  space.applicable(space.initial().data(), applicable);
  EXPECT_EQ(applicable.size(), 2u);
  stubborn.prune(space.initial().data(), applicable);
  return applicable.size();
}

TEST(StubbornSets, WhenTheOrderDoesNotMatter_ThenOneOrderIsLeft) {
  EXPECT_EQ(kept_of_two(":effect (p)", ":effect (q)"), 1u);
  EXPECT_EQ(kept_of_two(":precondition (r) :effect (p)", ":precondition (r) :effect (q)"), 1u);
  EXPECT_EQ(kept_of_two(":effect (and (p) (increase (x) 2))", ":effect (and (q) (decrease (x) 1))"), 1u);
  EXPECT_EQ(kept_of_two(":precondition (>= (x) 2) :effect (and (p) (increase (x) 2))",
                        ":precondition (>= (x) 3) :effect (and (q) (increase (x) 1))"),
            1u);
}

TEST(StubbornSets, WhenTheOrderMatters_ThenBothOrdersAreLeft) {
  const std::string one = ":effect (and (p) (not (r)))";
  EXPECT_EQ(kept_of_two(one, ":precondition (r) :effect (q)"), 2u);
  EXPECT_EQ(kept_of_two(one, ":effect (and (q) (when (r) (increase (cost) 1)))"), 2u);
  EXPECT_EQ(kept_of_two(one, ":precondition (or (r) (q)) :effect (q)"), 2u);
  EXPECT_EQ(kept_of_two(":precondition (>= (x) 2) :effect (and (p) (decrease (x) 3))",
                        ":precondition (>= (x) 2) :effect (and (q) (decrease (x) 3))"),
            2u);
  EXPECT_EQ(kept_of_two(":effect (and (p) (assign (x) 3))",
                        ":precondition (>= (x) 2) :effect (and (q) (increase (x) 1))"),
            2u);
  EXPECT_EQ(kept_of_two(":effect (and (p) (increase (x) 1))", ":effect (and (q) (increase (cost) (x)))"), 2u);
}

// Independent switches without a bound that tells the way: a search over all orders meets 2^16 states.
TEST(StubbornSets, WhenTheProofIsOfIndependentParts_ThenItDoesNotMeetAllTheirMixtures) {
  const Task task = switches_task(16);
  const GroundTask ground = ground_of(task);
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  LandmarkCut cut(relaxed, [] { return true; });  // stopped at once: counts one set
  SearchControl control(0ms, 0, nullptr);
  const LowerBounds bounds(space, [] { return true; });
  AStarSearch search(space, control, bounds, {.cut = &cut});
  StopReason reason = StopReason::None;
  ASSERT_EQ(search.run(100'000, reason), SearchStatus::Exhausted);
  EXPECT_EQ(control.best().quality.steps, 16u);
  EXPECT_LT(control.expanded(), 100u);
}

}  // namespace
}  // namespace stepwright::pddl
