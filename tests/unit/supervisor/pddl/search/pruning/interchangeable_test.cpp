// Which objects can change places, and that states that differ by nothing else are arranged alike. That
// nothing is pruned that an optimal plan needs is judged by enumeration (stubborn_sets_test,
// random_tasks_test).

#include "supervisor/pddl/search/pruning/interchangeable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/search/pruning/dominance.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

// Three carts on a line of places a, b, c move loads to c.
struct Carts {
  std::string statics{};  // facts that no action changes
  std::string extra{};    // actions
  std::string goal = "(lies x c) (lies y c)";
};

Task carts_task(const Carts& carts) {
  return testing::make_task(
      R"((define (domain carts) (:requirements :adl :numeric-fluents) (:types cart load place)
  (:predicates (at ?t - cart ?p - place) (lies ?l - load ?p - place) (in ?l - load ?t - cart)
               (next ?p ?q - place) (fast ?t - cart) (behind ?s ?t - cart))
  (:functions (used ?t - cart) (cost))
  (:action move :parameters (?t - cart ?p ?q - place) :precondition (and (at ?t ?p) (next ?p ?q))
    :effect (and (not (at ?t ?p)) (at ?t ?q) (increase (used ?t) 1) (increase (cost) (used ?t))))
  (:action take :parameters (?l - load ?t - cart ?p - place) :precondition (and (at ?t ?p) (lies ?l ?p))
    :effect (and (not (lies ?l ?p)) (in ?l ?t)))
  (:action drop :parameters (?l - load ?t - cart ?p - place) :precondition (and (at ?t ?p) (in ?l ?t))
    :effect (and (not (in ?l ?t)) (lies ?l ?p))))" +
          carts.extra + ")",
      "(define (problem p) (:domain carts) (:objects r s t - cart x y - load a b c - place) (:init (at r a) "
      "(at s b) (at t c) (lies x a) (lies y b) (next a b) (next b c) (next b a) (next c b) (= (used r) 2) "
      "(= (used s) 0) (= (used t) 1) (= (cost) 0) " +
          carts.statics + ") (:goal (and " + carts.goal + ")) (:metric minimize (cost)))");
}

// The sets as names, "r s t, x y".
std::string sets_of(const Task& task) {
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const StateSpace space(ground);
  std::string text;
  const Interchangeable found(space);
  for (const ExchangeSet& set : found.sets()) {
    text += text.empty() ? "" : ", ";
    for (const ExchangeMember& member : set.members) {
      text += ground.definition->objects[static_cast<std::size_t>(member.object)].name +
              (&member == &set.members.back() ? "" : " ");
    }
  }
  return text;
}

TEST(Interchangeable, WhenOnlyTheStateTellsObjectsApart_ThenTheyAreASet) {
  EXPECT_EQ(sets_of(carts_task({})), "r s t, x y");
}

TEST(Interchangeable, WhenGoalOrActionsTellObjectsApart_ThenTheyAreNot) {
  const std::string boost =
      "(:action boost :parameters (?t - cart) :precondition (and (fast ?t) (at ?t a)) :effect (and (not (at "
      "?t a)) "
      "(at ?t c) (increase (cost) 1)))";
  EXPECT_EQ(sets_of(carts_task({.goal = "(lies x c) (lies y b)"})), "r s t");
  EXPECT_EQ(sets_of(carts_task({.goal = "(lies x c) (lies y c) (at s a)"})), "r t, x y");
  EXPECT_EQ(sets_of(carts_task({.goal = "(lies x c) (lies y c) (>= (used t) 3)"})), "r s, x y");
  EXPECT_EQ(sets_of(carts_task({.statics = "(fast s)", .extra = boost})), "r t, x y");
  EXPECT_EQ(sets_of(carts_task({.statics = "(fast r) (fast s) (fast t)", .extra = boost})), "r s t, x y");
}

TEST(Interchangeable, WhenAFactMentionsTwoOfThem_ThenTheyAreNot) {
  const std::string follow =
      "(:action follow :parameters (?s ?t - cart) :precondition (and (at ?s a) (at ?t b)) :effect (and "
      "(behind ?s "
      "?t) (increase (cost) 1)))";
  EXPECT_EQ(sets_of(carts_task({.extra = follow,
                                .goal = "(lies x c) (lies y c) (exists (?s ?t - cart) (behind ?s "
                                        "?t))"})),
            "x y");
}

class Arranged : public ::testing::Test {
 protected:
  // The initial state with what it says of two carts exchanged.
  std::vector<Word> exchanged(const std::string& a, const std::string& b) const {
    std::vector<Word> state = space_.initial();
    const auto& objects = ground_.definition->objects;
    const auto name = [&](int o) { return objects[static_cast<std::size_t>(o)].name; };
    const auto image = [&](Atom atom) {
      for (int& o : atom.arguments) {
        const std::string to = name(o) == a ? b : name(o) == b ? a : name(o);
        while (name(o) != to) o = (o + 1) % static_cast<int>(objects.size());
      }
      return atom;
    };
    const std::vector<Word> before = state;
    for (std::size_t f = 0; f < ground_.facts.size(); ++f) {
      const auto to = static_cast<std::size_t>(
          std::find(ground_.facts.begin(), ground_.facts.end(), image(ground_.facts[f])) -
          ground_.facts.begin());
      const Word bit = Word{1} << (to & 63);
      state[to >> 6] =
          space_.fact(before.data(), static_cast<int>(f)) ? state[to >> 6] | bit : state[to >> 6] & ~bit;
    }
    for (std::size_t v = 0; v < ground_.variables.size(); ++v) {
      const auto to =
          std::find(ground_.variables.begin(), ground_.variables.end(), image(ground_.variables[v])) -
          ground_.variables.begin();
      state[space_.fact_words() + static_cast<std::size_t>(to)] = before[space_.fact_words() + v];
    }
    return state;
  }

  Task task_ = carts_task({});
  GroundTask ground_ = ground_task(task_.definition(), [] { return false; });
  StateSpace space_{ground_};
};

TEST_F(Arranged, WhenStatesDifferByAnExchange_ThenTheyAreArrangedAlike) {
  const Interchangeable objects(space_);
  std::vector<Word> state = space_.initial(), other = exchanged("r", "t"), third = exchanged("s", "t");
  ASSERT_NE(state, other);
  for (std::vector<Word>* s : {&state, &other, &third}) objects.arrange(s->data());
  EXPECT_EQ(state, other);
  EXPECT_EQ(state, third);
}

TEST_F(Arranged, WhenAnExchangedStateWasMet_ThenTheYoungerOneIsPrunedAndTheOlderOneKept) {
  Dominance dominance(space_);
  ASSERT_TRUE(dominance.useful());
  StateTable nodes(space_);
  const std::vector<Word> state = space_.initial(), other = exchanged("r", "s");
  const std::uint32_t older = nodes.insert(state.data()).first, younger = nodes.insert(other.data()).first;
  nodes[older] = {5.0, kNoNode, -1, 2, false};
  nodes[younger] = {4.0, kNoNode, -1, 2, false};
  EXPECT_FALSE(dominance.prunes(younger, other.data(), nodes));
  EXPECT_TRUE(dominance.prunes(older, state.data(), nodes));
  nodes[older].cost = 4.0;  // a better way to it: now both are as good
  EXPECT_FALSE(dominance.prunes(older, state.data(), nodes));
  EXPECT_TRUE(dominance.prunes(younger, other.data(), nodes));
}

}  // namespace
}  // namespace stepwright::pddl
