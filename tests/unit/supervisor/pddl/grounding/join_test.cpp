// Grounding by joins: relations, the bindings that are found, and the same tasks as by enumeration.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "supervisor/pddl/definition/atom_table.h"
#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/grounding/joiner.h"
#include "tests/bench/grounding/enumerating_grounder.h"
#include "tests/bench/grounding/generators.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

TEST(AtomTable, WhenManyAtomsAreInterned_ThenEachKeepsItsNumber) {
  AtomTable table;
  for (int round = 0; round < 2; ++round) {
    for (int i = 0; i < 5000; ++i) EXPECT_EQ(table.intern({i % 7, {i, i / 3}}), i);
  }
  EXPECT_EQ(table.size(), 5000u);
  EXPECT_EQ(table.find({1, {1, 1}}), -1);
  EXPECT_EQ(table.atoms()[8], (Atom{1, {8, 2}}));
  EXPECT_EQ(AtomTable().find({0, {}}), -1);
}

TEST(FactRelation, WhenIndexedBeforeAndAfterRowsArrive_ThenEveryRowIsFound) {
  FactRelation relation(3);
  const auto find = [&](std::uint64_t columns, std::vector<int> key) {
    const std::span<const int> rows = relation.find(columns, key);
    return std::vector<int>(rows.begin(), rows.end());
  };
  relation.add(std::vector<int>{1, 2, 3});
  EXPECT_EQ(find(0b001, {1}), (std::vector<int>{0}));
  relation.add(std::vector<int>{1, 2, 4});
  relation.add(std::vector<int>{2, 2, 4});
  EXPECT_EQ(find(0b001, {1}), (std::vector<int>{0, 1}));
  EXPECT_EQ(find(0b110, {2, 4}), (std::vector<int>{1, 2}));
  EXPECT_EQ(find(0b111, {2, 2, 4}), (std::vector<int>{2}));
  EXPECT_TRUE(find(0b010, {9}).empty());
}

// The bindings of all rules when every dynamic fact of the initial state arrives in order.
std::vector<std::string> joined(const Task& task) {
  const Definition& definition = task.definition();
  const std::vector<JoinRule> rules = join_rules(definition);
  std::vector<std::string> found;
  Joiner joiner(definition, rules, [&](const JoinRule& rule, Binding& binding) {
    std::string text = rule.action >= 0 ? definition.actions[static_cast<std::size_t>(rule.action)].name
                                        : "axiom " + std::to_string(rule.axiom);
    for (const Typed& variable : rule.variables) {
      const int object = binding[static_cast<std::size_t>(variable.slot)];
      text += " " + definition.objects[static_cast<std::size_t>(object)].name;
    }
    found.push_back(text);
    return true;
  });
  EXPECT_TRUE(joiner.start());
  for (const Atom& fact : definition.facts) {
    if (definition.predicates[static_cast<std::size_t>(fact.symbol)].changes) {
      EXPECT_TRUE(joiner.arrive(fact));
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

TEST(Joiner, WhenStaticFactsDecideADisjunction_ThenTheyAreJoinedAndEveryBindingIsFoundOnce) {
  const Task task = testing::make_task(
      R"((define (domain d) (:requirements :adl) (:predicates (at ?c) (right ?a ?b) (up ?a ?b) (open ?c) (shut ?c))
    (:action step :parameters (?a ?b)
      :precondition (and (at ?a) (or (and (right ?a ?b) (not (shut ?b))) (up ?b ?a)))
      :effect (and (at ?b) (not (at ?a))))
    (:action look :parameters (?a) :precondition (or (at ?a) (up ?a ?a)) :effect (open ?a))))",
      R"((define (problem p) (:domain d) (:objects x y z)
    (:init (shut z) (at x) (at y) (right x y) (right x z) (up y x) (up z y)) (:goal (open x))))");
  const std::vector<JoinRule> rules = join_rules(task.definition());
  ASSERT_EQ(rules.size(), 3u);  // (at ?a) is not static: one rule for (look ?a)
  EXPECT_EQ(rules[0].atoms.size(), 2u);
  EXPECT_EQ(rules[0].filters.size(), 1u);
  EXPECT_EQ(rules[1].atoms.size(), 2u);
  EXPECT_EQ(rules[1].filters.size(), 1u);  // that the first alternative does not hold
  std::vector<std::string> steps = joined(task);
  std::erase_if(steps, [](const std::string& text) { return text.starts_with("look"); });
  std::sort(steps.begin(), steps.end());
  EXPECT_EQ(steps, (std::vector<std::string>{"step x y", "step y z"}));  // x y by both alternatives
}

Task pairs_task(const std::string& precondition, const std::string& more = "") {
  return testing::make_task(
      "(define (domain d) (:requirements :adl :derived-predicates) (:types thing place)"
      " (:predicates (at ?t - thing ?p - place) (road ?a ?b - place) (ready) (done ?t - thing) (near ?a ?b - "
      "thing))"
      " (:action act :parameters (?t ?u - thing ?a ?b - place) :precondition " +
          precondition + " :effect (and (done ?t) (not (at ?t ?a)))) " + more + ")",
      "(define (problem p) (:domain d) (:objects k l - thing x y z - place)"
      " (:init (at k x) (at l x) (at l y) (road x y) (road y z) (road z z)) (:goal (done k)))");
}

TEST(Joiner, WhenOneFactMatchesTwoAtoms_ThenEachBindingIsFoundOnce) {
  EXPECT_EQ(
      joined(pairs_task("(and (at ?t ?a) (at ?u ?a) (road ?a ?b))")),
      (std::vector<std::string>{"act k k x y", "act k l x y", "act l k x y", "act l l x y", "act l l y z"}));
}

TEST(Joiner, WhenObjectsMustDiffer_ThenTheFilterCounts) {
  EXPECT_EQ(joined(pairs_task("(and (at ?t ?a) (at ?u ?a) (road ?a ?b) (not (= ?t ?u)))")),
            (std::vector<std::string>{"act k l x y", "act l k x y"}));
}

TEST(Joiner, WhenAnArgumentRepeats_ThenTheRowMustRepeatToo) {
  EXPECT_TRUE(joined(pairs_task("(and (at ?t ?a) (road ?a ?a) (= ?a ?b) (at ?u ?b))")).empty());
  EXPECT_EQ(joined(pairs_task("(and (at ?t ?a) (road ?b ?b) (at ?u y))")),
            (std::vector<std::string>{"act k l x z", "act l l x z", "act l l y z"}));
}

TEST(Joiner, WhenAVariableIsInNoAtom_ThenItTakesEveryObjectOfItsType) {
  EXPECT_EQ(joined(pairs_task("(and (at ?t ?a) (road ?a ?b) (not (road ?b ?b)))")).size(), 4u);
}

TEST(Joiner, WhenAnAxiomSaysSome_ThenTheJoinBindsIt) {
  const Task task =
      pairs_task("(near ?t ?u)",
                 "(:derived (near ?a ?b - thing) (or (exists (?p - place) (and (at ?a ?p) (at ?b ?p)))"
                 " (exists (?p ?q - place) (and (at ?a ?p) (road ?p ?q) (at ?b ?q)))"
                 " (exists (?t - thing) (done ?a))))");
  std::vector<std::string> axioms;
  for (const std::string& text : joined(task)) {
    if (text.substr(0, 5) == "axiom") axioms.push_back(text);
  }
  EXPECT_EQ(axioms,
            (std::vector<std::string>{"axiom 0 k k x", "axiom 0 k l x", "axiom 0 k l x y", "axiom 0 l k x",
                                      "axiom 0 l l x", "axiom 0 l l x y", "axiom 0 l l y"}));
}

TEST(Joiner, WhenNobodyReadsWhatSomeBinds_ThenOneWitnessIsEnough) {
  const Task task =
      pairs_task("(near ?t ?u)",
                 "(:derived (near ?a ?b - thing) (exists (?p ?q - place) (and (ready) (at ?a ?p))))"
                 "(:action prepare :parameters () :effect (ready))");
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  // (ready) makes (near k _) from x and (near l _) from x and y.
  EXPECT_EQ(ground.axioms.size(), 6u);
}

// What the two groundings find, by names.
struct Found {
  std::set<std::string> operators, facts, groups;
  std::map<std::string, Interval> bounds;
  friend bool operator==(const Found&, const Found&) = default;
};

Found named(const Definition& definition, const GroundTask& ground) {
  Found found;
  for (const GroundOperator& op : ground.operators) {
    found.operators.insert(model::to_string(action_of(ground, op)) + " " + std::to_string(op.effects.size()));
  }
  for (const Atom& fact : ground.facts) found.facts.insert(fact_name(definition, fact));
  for (const FactGroup& group : ground.groups) {
    std::set<std::string> names;
    for (const int fact : group.facts)
      names.insert(fact_name(definition, ground.facts[static_cast<std::size_t>(fact)]));
    std::string text = group.exactly_one ? "!" : "";
    for (const std::string& name : names) text += name;
    found.groups.insert(text);
  }
  for (std::size_t v = 0; v < ground.variables.size(); ++v) {
    found.bounds[fluent_name(definition, ground.variables[v])] = ground.bounds[v];
  }
  return found;
}

TEST(Grounding, WhenInstancesAreGenerated_ThenJoinsFindWhatEnumerationFinds) {
  for (const auto generator : bench::grounding::generators()) {
    for (const int objects : {10, 30, 60}) {
      const auto instance = generator(objects);
      SCOPED_TRACE(instance.name + " " + std::to_string(objects));
      const Task task = testing::make_task(instance.domain, instance.problem);
      const auto never = [] { return false; };
      const Found now = named(task.definition(), ground_task(task.definition(), never));
      const Found before =
          named(task.definition(), baseline::ground_by_enumeration(task.definition(), never));
      EXPECT_EQ(now.operators, before.operators);
      EXPECT_EQ(now.facts, before.facts);
      EXPECT_EQ(now.bounds, before.bounds);
      EXPECT_FALSE(now.operators.empty());
    }
  }
}

TEST(Grounding, WhenTheBenchIsJoined_ThenAsByEnumeration) {
  for (const std::string suffix : {"", "_load"}) {
    const Task task = testing::bench_task(suffix);
    const auto never = [] { return false; };
    EXPECT_EQ(named(task.definition(), ground_task(task.definition(), never)),
              named(task.definition(), baseline::ground_by_enumeration(task.definition(), never)));
  }
}

TEST(Grounding, WhenAThousandRoadsAreJoined_ThenOnlyRoadsBecomeOperators) {
  const Task task = testing::logistics_task(400);
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  EXPECT_EQ(ground.operators.size(), 798u + 4u * 400u);
}

}  // namespace
}  // namespace stepwright::pddl
