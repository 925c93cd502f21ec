// What more or less of a fluent is worth, and which states are needless beside others. That nothing is pruned
// that an optimal plan needs is judged by enumeration (random_tasks_test).

#include "supervisor/pddl/search/pruning/dominance.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/search/portfolio/proof.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

// A van with fuel on a ring of stops; `extra` actions, `goal` beside being home.
Task van_task(const std::string& extra = {}, const std::string& goal = {}) {
  return testing::make_task(
      R"((define (domain van) (:requirements :adl :numeric-fluents) (:types stop)
  (:predicates (at ?s - stop) (next ?a ?b - stop) (home) (pump ?s - stop))
  (:functions (fuel) (heat) (cost))
  (:action drive :parameters (?a ?b - stop) :precondition (and (at ?a) (next ?a ?b) (>= (fuel) 1) (< (heat) 9))
    :effect (and (not (at ?a)) (at ?b) (decrease (fuel) 1) (increase (heat) 2) (increase (cost) 1)))
  (:action rest :parameters (?a - stop) :precondition (at ?a) :effect (and (assign (heat) 0) (increase (cost) 2)))
  (:action fill :parameters (?a - stop) :precondition (and (at ?a) (pump ?a) (< (fuel) 5))
    :effect (and (assign (fuel) 5) (increase (cost) 1)))
  (:action arrive :parameters () :precondition (at c) :effect (home)))" +
          extra + ")",
      "(define (problem p) (:domain van) (:objects a b c - stop) (:init (at a) (next a b) (next b a) (next b "
      "c) "
      "(next c a) (pump b) (= (fuel) 3) (= (heat) 4) (= (cost) 0)) (:goal (and (home) " +
          goal + ")) (:metric minimize (cost)))");
}

Preference preference_of(const Task& task, const std::string& function) {
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const std::vector<Preference> list = preferences(ground);
  for (std::size_t v = 0; v < list.size(); ++v) {
    const auto symbol = static_cast<std::size_t>(ground.variables[v].symbol);
    if (ground.definition->functions[symbol].name == function) return list[v];
  }
  ADD_FAILURE() << "no variable " << function;
  return Preference::Exact;
}

TEST(Preferences, WhenAllAskForMoreOrForLess_ThenThatIsBetter) {
  const Task task = van_task();
  EXPECT_EQ(preference_of(task, "fuel"), Preference::More);  // filling up asks for less, in vain
  EXPECT_EQ(preference_of(task, "heat"), Preference::Less);
}

TEST(Preferences, WhenSomethingReadsTheFluentOtherwise_ThenItCountsAsItIs) {
  const std::string head = "(:action more :parameters () ", tail = " (increase (cost) 1)))";
  const std::string actions[] = {
      head + ":precondition (<= (fuel) 1) :effect (and (home)" + tail,
      head + ":precondition (= (fuel) 1) :effect (and (home)" + tail,
      head + ":precondition (< (fuel) 5) :effect (and (assign (fuel) 6)" + tail,  // more than it asks about
      head + ":precondition (< (fuel) 5) :effect (and (assign (fuel) 5) (home)" + tail,
      head + ":effect (and (when (> (fuel) 2) (home))" + tail,
      head + ":effect (and (assign (heat) (fuel))" + tail,
      head + ":effect (and (home) (increase (cost) (fuel))" + tail,
      head + ":effect (and (scale-up (fuel) 0)" + tail,
  };
  for (const std::string& action : actions) {
    EXPECT_EQ(preference_of(van_task(action), "fuel"), Preference::Exact) << action;
  }
  EXPECT_EQ(preference_of(van_task({}, "(<= (fuel) 2)"), "fuel"), Preference::Exact);
  EXPECT_EQ(preference_of(van_task({}, "(or (at a) (>= (fuel) 2))"), "fuel"), Preference::More);
}

// A search that has met some states of the van.
class DominanceOfStates : public ::testing::Test {
 protected:
  bool prunes(double fuel, double heat, double cost, std::uint32_t steps, int op) {
    std::vector<Word> state = space_.initial(), other(space_.words());
    double ignored = 0.0;
    if (op >= 0) {
      space_.apply(op, state.data(), other.data(), ignored);
      state.swap(other);
    }
    for (std::size_t v = 0; v < ground_.variables.size(); ++v) {
      const auto symbol = static_cast<std::size_t>(ground_.variables[v].symbol);
      const bool is_fuel = ground_.definition->functions[symbol].name == "fuel";
      state[space_.fact_words() + v] = std::bit_cast<Word>(is_fuel ? fuel : heat);
    }
    const std::uint32_t node = nodes_.insert(state.data()).first;
    nodes_[node] = {cost, kNoNode, -1, steps, false};
    return dominance_.prunes(node, state.data(), nodes_);
  }

  Task task_ = van_task();
  GroundTask ground_ = ground_task(task_.definition(), [] { return false; });
  StateSpace space_{ground_};
  StateTable nodes_{space_};
  Dominance dominance_{space_};
};

TEST_F(DominanceOfStates, WhenAnotherHasAllThatAndIsNoDearer_ThenPruned) {
  ASSERT_TRUE(dominance_.useful());
  EXPECT_FALSE(prunes(3, 4, 5, 2, -1));
  EXPECT_TRUE(prunes(2, 4, 5, 2, -1));
  EXPECT_TRUE(prunes(3, 6, 5, 3, -1));
  EXPECT_TRUE(prunes(3, 8, 6, 1, -1));
}

TEST_F(DominanceOfStates, WhenItIsBetterInSomething_ThenKept) {
  EXPECT_FALSE(prunes(3, 4, 5, 2, -1));
  EXPECT_FALSE(prunes(3, 4, 5, 2, -1));  // the same one once more
  EXPECT_FALSE(prunes(4, 6, 5, 2, -1));
  EXPECT_FALSE(prunes(2, 2, 5, 2, -1));
  EXPECT_FALSE(prunes(1, 4, 4, 9, -1));
  EXPECT_FALSE(prunes(2, 6, 4, 1, -1));
  std::vector<int> applicable;
  space_.applicable(space_.initial().data(), applicable);
  for (const int op : applicable) {
    std::vector<Word> next(space_.words());
    const std::vector<Word> initial = space_.initial();
    double cost = 0.0;
    space_.apply(op, initial.data(), next.data(), cost);
    if (std::equal(initial.begin(), initial.begin() + static_cast<std::ptrdiff_t>(space_.fact_words()),
                   next.begin()))
      continue;
    EXPECT_FALSE(prunes(1, 6, 7, 9, op));  // elsewhere
  }
}

}  // namespace
}  // namespace stepwright::pddl
