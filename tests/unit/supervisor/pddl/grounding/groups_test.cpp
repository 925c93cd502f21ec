// Fact groups: what is found in well-known domains, and that no reachable state breaks what is claimed.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "supervisor/pddl/grounding/fact_groups.h"
#include "supervisor/pddl/grounding/grounder.h"
#include "tests/support/pddl/exhaustive.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

GroundTask ground_all(const Task& task) {
  return ground_task(task.definition(), [] { return false; });
}

// "(at t p1)|(at t p2)!": the facts of the groups of two and more; '!' = exactly one.
std::set<std::string> described(const Task& task) {
  const GroundTask ground = ground_all(task);
  std::set<std::string> groups;
  for (const FactGroup& group : ground.groups) {
    if (group.facts.size() < 2) continue;
    std::set<std::string> names;
    for (const int fact : group.facts) {
      names.insert(fact_name(task.definition(), ground.facts[static_cast<std::size_t>(fact)]));
    }
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : "|") + name;
    groups.insert(text + (group.exactly_one ? "!" : ""));
  }
  return groups;
}

// Every fact is in one group, and every reachable state keeps what the groups claim. The number of groups of
// two and more.
std::size_t expect_sound(const Task& task) {
  const GroundTask ground = ground_all(task);
  std::vector<int> uses(ground.facts.size(), 0);
  std::size_t large = 0;
  for (const FactGroup& group : ground.groups) {
    for (const int fact : group.facts) ++uses[static_cast<std::size_t>(fact)];
    if (group.facts.size() > 1) ++large;
  }
  EXPECT_EQ(uses, std::vector<int>(ground.facts.size(), 1));
  testing::for_each_reachable_state(task, 20000, [&](const LiftedState& state) {
    const auto held_of = [&](const std::vector<int>& facts) {
      return std::count_if(facts.begin(), facts.end(), [&](int fact) {
        return state.facts.count(ground.facts[static_cast<std::size_t>(fact)]) != 0;
      });
    };
    for (const std::vector<int>& set : ground.exclusive) EXPECT_LE(held_of(set), 1);
    for (const FactGroup& group : ground.groups) {
      const auto held = held_of(group.facts);
      EXPECT_LE(held, 1) << fact_name(task.definition(),
                                      ground.facts[static_cast<std::size_t>(group.facts[0])]);
      EXPECT_TRUE(held == 1 || !group.exactly_one);
    }
  });
  return large;
}

constexpr const char* kBlocks = R"((define (domain blocks) (:requirements :strips)
  (:predicates (on ?x ?y) (ontable ?x) (clear ?x) (handempty) (holding ?x))
  (:action pick-up :parameters (?x) :precondition (and (clear ?x) (ontable ?x) (handempty))
    :effect (and (not (ontable ?x)) (not (clear ?x)) (not (handempty)) (holding ?x)))
  (:action put-down :parameters (?x) :precondition (holding ?x)
    :effect (and (not (holding ?x)) (clear ?x) (handempty) (ontable ?x)))
  (:action stack :parameters (?x ?y) :precondition (and (holding ?x) (clear ?y))
    :effect (and (not (holding ?x)) (not (clear ?y)) (clear ?x) (handempty) (on ?x ?y)))
  (:action unstack :parameters (?x ?y) :precondition (and (on ?x ?y) (clear ?x) (handempty))
    :effect (and (holding ?x) (clear ?y) (not (clear ?x)) (not (handempty)) (not (on ?x ?y))))))";

Task blocks_task() {
  return testing::make_task(kBlocks, R"((define (problem three) (:domain blocks) (:objects a b c)
    (:init (ontable a) (on b a) (clear b) (ontable c) (clear c) (handempty))
    (:goal (and (on a b) (on b c)))))");
}

TEST(Groups, WhenTheTaskIsLogistics_ThenEachThingHasOnePlace) {
  const std::set<std::string> groups = described(testing::logistics_task(3));
  EXPECT_EQ(groups, (std::set<std::string>{"(at t p1)|(at t p2)|(at t p3)!",
                                           "(at k1 p1)|(at k1 p2)|(at k1 p3)|(in k1 t)!",
                                           "(at k2 p1)|(at k2 p2)|(at k2 p3)|(in k2 t)!"}));
}

TEST(Groups, WhenTheTaskIsBlocks_ThenOnEachBlockIsOneThingOrItIsClearOrHeld) {
  // Where a block is would do as well; the sets overlap, and those found first go first.
  EXPECT_EQ(described(blocks_task()),
            (std::set<std::string>{"(clear a)|(holding a)|(on a a)|(on b a)|(on c a)!",
                                   "(clear b)|(holding b)|(on a b)|(on b b)|(on c b)!",
                                   "(clear c)|(holding c)|(on a c)|(on b c)|(on c c)!"}));
  EXPECT_EQ(expect_sound(blocks_task()), 3u);
}

TEST(Groups, WhenTheTaskIsTheBench_ThenTheVehicleHasOnePlace) {
  EXPECT_EQ(described(testing::bench_task()),
            std::set<std::string>{"(is-at v1 a1)|(is-at v1 a2)|(is-at v1 f1)!"});
}

// One token on three places; `go` is the only action, its effect is given.
Task token_task(const std::string& effect, const std::string& precondition = "(and (at ?a) (road ?a ?b))",
                const std::string& more = "") {
  return testing::make_task(
      "(define (domain d) (:requirements :adl) (:predicates (at ?p) (road ?a ?b) (off) (lit))"
      " (:action go :parameters (?a ?b) :precondition " +
          precondition + " :effect " + effect + ") " + more + ")",
      "(define (problem p) (:domain d) (:objects x y z) (:init (at x) (road x y) (road y z) (road z x))"
      " (:goal (and (at z) (not (at x)) (not (at y)))))");
}

TEST(Groups, WhenAMoveDeletesWhereItWas_ThenExactlyOne) {
  const Task task = token_task("(and (not (at ?a)) (at ?b))");
  EXPECT_EQ(described(task), std::set<std::string>{"(at x)|(at y)|(at z)!"});
  EXPECT_EQ(expect_sound(task), 1u);
}

TEST(Groups, WhenAMoveLeavesTheOldFact_ThenNoGroup) {
  const Task task = token_task("(and (at ?b))", "(and (at ?a) (road ?a ?b))",
                               "(:action drop :parameters (?a) :precondition (at ?a) :effect (not (at ?a)))");
  EXPECT_TRUE(described(task).empty());
  EXPECT_EQ(expect_sound(task), 0u);
}

TEST(Groups, WhenTheTokenCanBeLost_ThenAtMostOne) {
  const Task task = token_task("(and (not (at ?a)) (at ?b))", "(and (at ?a) (road ?a ?b))",
                               "(:action lose :parameters (?a) :precondition (at ?a) :effect (not (at ?a)))");
  EXPECT_EQ(described(task), std::set<std::string>{"(at x)|(at y)|(at z)"});
  EXPECT_EQ(expect_sound(task), 1u);
}

TEST(Groups, WhenTheDeleteIsConditionalOnSomethingElse_ThenNoGroup) {
  const std::string light =
      "(:action light :parameters () :precondition (off) :effect (lit))"
      "(:action turn-off :parameters () :effect (off))"
      "(:action dark :parameters () :effect (not (lit)))";
  const Task task =
      token_task("(and (when (lit) (not (at ?a))) (at ?b))", "(and (at ?a) (road ?a ?b))", light);
  EXPECT_TRUE(described(task).empty());
  EXPECT_EQ(expect_sound(task), 0u);
  const Task joined =
      token_task("(when (lit) (and (not (at ?a)) (at ?b)))", "(and (at ?a) (road ?a ?b))", light);
  EXPECT_EQ(described(joined), std::set<std::string>{"(at x)|(at y)|(at z)!"});
  EXPECT_EQ(expect_sound(joined), 1u);
}

TEST(Groups, WhenAllOthersAreDeleted_ThenExactlyOneWithoutAPrecondition) {
  for (const std::string effect : {"(and (forall (?q) (not (at ?q))) (at ?b))",
                                   "(and (forall (?q) (when (at ?q) (not (at ?q)))) (at ?b))"}) {
    const Task task = token_task(effect, "(road ?a ?b)");
    EXPECT_EQ(described(task), std::set<std::string>{"(at x)|(at y)|(at z)!"}) << effect;
    EXPECT_EQ(expect_sound(task), 1u);
  }
}

TEST(Groups, WhenParametersAreTheSameObject_ThenAddsWinOverDeletes) {
  // Without the road, ?a and ?b can be one place: the token stays.
  const Task task = token_task("(and (not (at ?a)) (at ?b))", "(at ?a)");
  EXPECT_EQ(described(task), std::set<std::string>{"(at x)|(at y)|(at z)!"});
  EXPECT_EQ(expect_sound(task), 1u);
}

TEST(Groups, WhenTwoTokensAreThereAtFirst_ThenNoGroup) {
  const Task task = testing::make_task(
      "(define (domain d) (:requirements :strips) (:predicates (at ?p))"
      " (:action go :parameters (?a ?b) :precondition (at ?a) :effect (and (not (at ?a)) (at ?b))))",
      "(define (problem p) (:domain d) (:objects x y z) (:init (at x) (at y)) (:goal (at z)))");
  EXPECT_TRUE(described(task).empty());
  EXPECT_EQ(expect_sound(task), 0u);
}

TEST(Groups, WhenTwoFactsSwitch_ThenOneVariable) {
  const Task task = testing::make_task(
      "(define (domain d) (:requirements :strips) (:predicates (open ?d) (shut ?d))"
      " (:action o :parameters (?d) :precondition (shut ?d) :effect (and (not (shut ?d)) (open ?d)))"
      " (:action s :parameters (?d) :precondition (open ?d) :effect (and (not (open ?d)) (shut ?d))))",
      "(define (problem p) (:domain d) (:objects a b) (:init (open a) (shut b))"
      " (:goal (and (shut a) (open b))))");
  EXPECT_EQ(described(task), (std::set<std::string>{"(open a)|(shut a)!", "(open b)|(shut b)!"}));
}

TEST(Groups, WhenSetsOverlap_ThenTheLargestGoesFirstAndTheRestLosesItsCertainty) {
  const std::vector<FactGroup> groups =
      choose_groups({{{0, 1}, true}, {{1, 2, 3}, true}, {{0, 3, 4, 5}, true}}, 7);
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups[0].facts, (std::vector<int>{0, 3, 4, 5}));
  EXPECT_TRUE(groups[0].exactly_one);
  EXPECT_EQ(groups[1].facts, (std::vector<int>{1, 2}));
  EXPECT_FALSE(groups[1].exactly_one);
  EXPECT_EQ(groups[2].facts, std::vector<int>{6});
}

// Things at places, in a box or in a hand. Actions move them as they should, but for random faults: a missing
// delete, an effect under a condition, parameters that may be equal, a second add.
class Generator {
 public:
  explicit Generator(std::uint32_t seed) : random_(seed) {}

  std::string domain() {
    std::string text = R"((define (domain d) (:requirements :adl) (:types thing place)
      (:predicates (at ?t - thing ?p - place) (held ?t - thing) (free) (lit) (near ?a ?b - place))
)";
    const int count = 2 + pick(4);
    for (int i = 0; i < count; ++i) text += action(i);
    return text + ")";
  }

  std::string problem() {
    std::string init = "(near x y) (near y z) (near z x)";
    for (const std::string thing : {"a", "b"}) {
      if (pick(6) != 0) init += " (at " + thing + " " + place() + ")";
      if (pick(8) == 0) init += " (held " + thing + ")";
    }
    if (pick(3) != 0) init += " (free)";
    if (pick(2) == 0) init += " (lit)";
    return "(define (problem p) (:domain d) (:objects a b - thing x y z - place) (:init " + init +
           ") (:goal (and (at a x) (at b y) (lit) (not (free)) (held a) (not (held b)) (not (at a z)))))";
  }

 private:
  int pick(int count) { return static_cast<int>(random_() % static_cast<std::uint32_t>(count)); }
  std::string place() { return std::string(1, "xyz"[pick(3)]); }

  std::string fact() {
    static const char* facts[] = {"(at ?t ?a)", "(at ?t ?b)", "(held ?t)", "(free)", "(lit)", "(at ?u ?a)"};
    return facts[pick(6)];
  }

  // The fault rate is low enough for invariants to remain in many tasks.
  std::string effect(const std::string& usual) {
    if (pick(12) == 0) return "";
    if (pick(10) == 0) return "(when " + (pick(2) == 0 ? fact() : "(not " + fact() + ")") + " " + usual + ")";
    if (pick(14) == 0) return usual + " " + fact();
    if (pick(14) == 0) return usual + " (not " + fact() + ")";
    return usual;
  }

  std::string action(int index) {
    std::string condition, effects;
    switch (pick(5)) {
      case 0:
        condition = pick(3) == 0 ? "(at ?t ?a)" : "(at ?t ?a) (near ?a ?b)";
        effects = effect("(not (at ?t ?a))") + effect("(at ?t ?b)");
        break;
      case 1:
        condition = "(at ?t ?a) (free)";
        effects = effect("(not (at ?t ?a))") + effect("(not (free))") + effect("(held ?t)");
        break;
      case 2:
        condition = "(held ?t)";
        effects = effect("(not (held ?t))") + effect("(free)") + effect("(at ?t ?b)");
        break;
      case 3:
        condition = "(at ?t ?a) (at ?u ?b)";
        effects = effect("(not (at ?t ?a))") + effect("(at ?t ?b)") + effect("(not (at ?u ?b))") +
                  effect("(at ?u ?a)");
        break;
      default:
        condition = pick(2) == 0 ? "(lit)" : "(not (lit))";
        effects = effect(condition == "(lit)" ? "(not (lit))" : "(lit)") +
                  "(forall (?q - place) (when (at ?u ?q) (not (at ?u ?q))))" + effect("(at ?u ?a)");
        break;
    }
    if (pick(4) == 0) condition += " (not (= ?t ?u))";
    if (pick(6) == 0) condition += " (or (lit) " + fact() + ")";
    if (pick(8) == 0) condition += " (not " + fact() + ")";
    return "(:action a" + std::to_string(index) +
           " :parameters (?t ?u - thing ?a ?b - place) :precondition (and " + condition + ") :effect (and " +
           effects + "))\n";
  }

  std::mt19937 random_;
};

class RandomGroups : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(RandomGroups, WhenEveryReachableStateIsVisited_ThenEveryGroupHolds) {
  std::size_t groups = 0;
  for (std::uint32_t i = 0; i < 60; ++i) {
    Generator generator(GetParam() * 1000 + i);
    const std::string domain = generator.domain();
    const std::string problem = generator.problem();
    SCOPED_TRACE(domain + problem);
    groups += expect_sound(testing::make_task(domain, problem));
    if (HasFailure()) return;
  }
  EXPECT_GT(groups, 20u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomGroups, ::testing::Range(1u, 9u));

}  // namespace
}  // namespace stepwright::pddl
