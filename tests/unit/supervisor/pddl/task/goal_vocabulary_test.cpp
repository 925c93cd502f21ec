#include "supervisor/pddl/task/goal_vocabulary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

using ::testing::ElementsAre;

const GoalSymbol* find(const std::vector<GoalSymbol>& symbols, const std::string& name) {
  for (const GoalSymbol& symbol : symbols) {
    if (symbol.name == name) return &symbol;
  }
  return nullptr;
}

TEST(GoalVocabulary, WhenTheBenchIsAsked_ThenWhatActionsChangeIsThereWithItsObjects) {
  const GoalVocabulary words = goal_vocabulary(testing::bench_task());
  ASSERT_EQ(words.predicates.size(), 1u) << "(serves ?d ?c) never changes";
  EXPECT_EQ(words.predicates[0].name, "is-at");
  ASSERT_EQ(words.predicates[0].parameters.size(), 2u);
  EXPECT_EQ(words.predicates[0].parameters[1].name, "p");
  EXPECT_EQ(words.predicates[0].parameters[1].type, "place");
  EXPECT_THAT(words.objects.at("place"), ElementsAre("f1", "a1", "a2")) << "those of its subtypes";
  EXPECT_THAT(words.objects.at("vehicle"), ElementsAre("v1"));
  ASSERT_NE(find(words.functions, "level"), nullptr);
  EXPECT_TRUE(find(words.functions, "level")->changes);
  ASSERT_NE(find(words.functions, "demand"), nullptr);
  EXPECT_FALSE(find(words.functions, "demand")->changes);
  EXPECT_FALSE(words.objects.contains("supplier")) << "nothing that a goal can speak of takes one";
}

TEST(GoalVocabulary, WhenAPredicateIsDerived_ThenAGoalMaySpeakOfIt) {
  const Task task = testing::make_task(
      "(define (domain d) (:requirements :typing :derived-predicates) (:types thing)"
      " (:predicates (on ?t - thing) (lit ?t - thing) (fixed ?t - thing))"
      " (:derived (lit ?t - thing) (on ?t))"
      " (:action switch :parameters (?t - thing) :precondition (fixed ?t) :effect (on ?t)))",
      "(define (problem p) (:domain d) (:objects a b - thing) (:init (fixed a)) (:goal (lit a)))");
  const GoalVocabulary words = goal_vocabulary(task);
  EXPECT_NE(find(words.predicates, "lit"), nullptr);
  EXPECT_NE(find(words.predicates, "on"), nullptr);
  EXPECT_EQ(find(words.predicates, "fixed"), nullptr);
}

TEST(GoalVocabulary, WhenThereAreSeveralConjuncts_ThenEachHasALineOfItsOwn) {
  EXPECT_EQ(goal_text({"(on a)"}), "(on a)");
  EXPECT_EQ(goal_text({"(on a)", "(not (on b))"}), "(and\n  (on a)\n  (not (on b)))");
  const Task task = testing::bench_task();
  const auto wrong = task.with_goal("(and\n  (is-at v1 f1)\n  (= (level a9) 3))");
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().front().where.line, 3u);
  EXPECT_TRUE(task.with_goal(goal_text(task.goals())));
}

}  // namespace
}  // namespace stepwright::pddl
