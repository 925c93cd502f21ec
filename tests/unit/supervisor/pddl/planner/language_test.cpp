// The whole language against the naive interpreter, on random tasks.

#include <gtest/gtest.h>

#include "supervisor/pddl/definition/ast.h"
#include "supervisor/pddl/planner/solve.h"
#include "tests/support/pddl/naive/feature_task.h"
#include "tests/support/pddl/naive/same_meaning.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

class Language : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(Language, WhenRandomTasksAreWalkedThrough_ThenExecutorAndGroundTaskMeanTheSame) {
  testing::Walked all;
  for (std::uint32_t i = 0; i < 60 && !HasFailure(); ++i) {
    const testing::TaskText text = testing::feature_task(GetParam() * 1000 + i);
    const testing::Walked walked = testing::expect_same_meaning(text.domain, text.problem, 40);
    all.states += walked.states;
    all.steps += walked.steps;
    all.goals += walked.goals;
  }
  // Else the tasks do not get anywhere.
  EXPECT_GT(all.states, 400u);
  EXPECT_GT(all.steps, 1000u);
  EXPECT_GT(all.goals, 20u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Language, ::testing::Range(1u, 13u));

constexpr const char* kEither = R"((define (domain d) (:requirements :typing)
  (:types car ship - vehicle vehicle crate - object)
  (:predicates (clean ?x - (either car crate)) (at ?v - vehicle))
  (:action wash :parameters (?x - (either crate car)) :effect (clean ?x))
  (:action go :parameters (?c - car) :precondition (clean ?c) :effect (at ?c))))";

TEST(Either, WhenAParameterIsOfEitherType_ThenObjectsOfBothFitAndNoOthers) {
  const Task task = testing::make_task(kEither, R"((define (problem p) (:domain d)
    (:objects c - car s - ship k - crate) (:init) (:goal (and (clean k) (at c)))))");
  const testing::Walked walked = testing::expect_same_meaning(kEither,
                                                              R"((define (problem p) (:domain d)
    (:objects c - car s - ship k - crate) (:init) (:goal (and (clean k) (at c)))))",
                                                              100);
  EXPECT_EQ(walked.states, 6u);
  EXPECT_EQ(walked.goals, 1u);
}

TEST(Either, WhenTheWrongTypeIsGiven_ThenTheUnionIsNamed) {
  const auto task = parse_task({"d", kEither}, {"p", R"((define (problem p) (:domain d)
    (:objects s - ship) (:init (clean s)) (:goal (clean s))))"});
  ASSERT_FALSE(task.has_value());
  EXPECT_EQ(task.error()[0].code, "P0107");
  EXPECT_NE(task.error()[0].message.find("(either car crate)"), std::string::npos)
      << result::to_string(task.error());
}

TEST(Either, WhenAnObjectIsOfSeveralTypes_ThenItFitsWhereEachOfThemDoes) {
  const char* problem = R"((define (problem p) (:domain d)
    (:objects b - (either crate car) f - (either car ship) k - crate s - ship) (:init)
    (:goal (and (clean b) (at b) (clean f) (at f)))))";
  const testing::Walked walked = testing::expect_same_meaning(kEither, problem, 200);
  // b and f are washed or not and then, as cars, gone or not; k is washed or not; s does nothing.
  EXPECT_EQ(walked.states, 18u);
  EXPECT_EQ(walked.goals, 2u);
  EXPECT_EQ(solve(testing::make_task(kEither, problem)).plan->actions.size(), 4u);
}

TEST(Either, WhenAnObjectIsOfTwoTypesWithACommonAncestor_ThenItIsThatOnce) {
  const Task task = testing::make_task(kEither, R"((define (problem p) (:domain d)
    (:objects a - (either car ship car) s - ship) (:init) (:goal (at a))))");
  const Definition& definition = task.definition();
  const auto objects_of = [&](const char* type) {
    return definition.objects_by_type[static_cast<std::size_t>(definition.type_ids.at(type))];
  };
  EXPECT_EQ(objects_of("vehicle"), (std::vector<int>{0, 1}));
  EXPECT_EQ(objects_of("car"), (std::vector<int>{0}));
  EXPECT_EQ(objects_of("crate"), (std::vector<int>{}));
  EXPECT_EQ(objects_of("object"), (std::vector<int>{0, 1}));
}

TEST(Either, WhenAnObjectOfSeveralTypesFitsNowhere_ThenAllAreNamed) {
  const auto task = parse_task({"d", kEither}, {"p", R"((define (problem p) (:domain d)
    (:objects a - (either car crate) b - (either ship vehicle)) (:init (clean a) (clean b)) (:goal (clean a))))"});
  ASSERT_FALSE(task.has_value());
  ASSERT_EQ(task.error().size(), 1u) << result::to_string(task.error());
  EXPECT_NE(task.error()[0].message.find("'b' is of type 'ship and vehicle'"), std::string::npos)
      << result::to_string(task.error());
}

TEST(Either, WhenAnEitherVariableIsUsedAsOneOfThem_ThenTypeError) {
  std::string domain = kEither;
  domain.replace(domain.find("(?c - car)"), 10, "(?c - (either car ship crate))");
  const auto task = parse_task({"d", domain}, {"p", R"((define (problem p) (:domain d)
    (:objects c - car) (:init) (:goal (clean c))))"});
  ASSERT_FALSE(task.has_value());
  EXPECT_EQ(task.error()[0].code, "P0107");
  EXPECT_EQ(task.error()[0].where.line, 5u);
}

}  // namespace
}  // namespace stepwright::pddl
