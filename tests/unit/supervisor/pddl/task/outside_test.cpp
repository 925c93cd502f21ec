#include "supervisor/pddl/task/outside.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "supervisor/pddl/plan/validate.h"
#include "supervisor/pddl/planner/solve.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

// Each thing is turned and polished once, in any order: with n things there are (2n)! plans.
constexpr const char* kDomain = R"((define (domain d)
  (:requirements :typing :negative-preconditions)
  (:types thing)
  (:predicates (turned ?x - thing) (polished ?x - thing) (can-turn ?x - thing) (is-turned ?x - thing))
  (:action turn :parameters (?x - thing)
    :precondition (and (not (turned ?x)) (can-turn ?x))
    :effect (and (turned ?x) (is-turned ?x)))
  (:action polish :parameters (?x - thing)
    :precondition (not (polished ?x))
    :effect (polished ?x)))
)";
constexpr const char* kProblem = R"((define (problem p) (:domain d) (:objects a b - thing)
  (:init) (:goal (and (turned a) (polished a) (turned b) (polished b)))))";

const CountedActions kCounted = {{"turn", 0}, {"polish", 0}};

std::string text_of(const std::vector<model::GroundAction>& actions) {
  std::string text;
  for (const model::GroundAction& each : actions) text += to_string(each);
  return text;
}

// All plans, by forbidding each that was found.
std::set<std::string> all_plans(const Task& task, std::vector<Beginning> forbidden) {
  std::set<std::string> found;
  for (;;) {
    Options options;
    options.first_only = true;
    const model::Outcome outcome = solve(without_beginnings(task, kCounted, forbidden), options);
    if (!outcome.plan) {
      EXPECT_EQ(outcome.kind, model::OutcomeKind::Infeasible);
      return found;
    }
    PlanText text;
    text.actions = outcome.plan->actions;
    text.lines.assign(text.actions.size(), 0);
    EXPECT_TRUE(validate(task, text).valid);
    EXPECT_TRUE(found.insert(text_of(text.actions)).second) << "found again";
    if (found.size() > 24) return found;
    forbidden.push_back({text.actions});
  }
}

TEST(OutsideTask, WhenPredicatesAreTakenOut_ThenWhatEachActionAsksAndDoesIsKnown) {
  const auto split = split_outside(testing::make_task(kDomain, kProblem), {"can-turn", "is-turned"});
  ASSERT_TRUE(split);
  ASSERT_EQ(split->conditions.at("turn").size(), 1u);
  EXPECT_EQ(split->conditions.at("turn")[0].predicate, "can-turn");
  EXPECT_EQ(split->effects.at("turn")[0].of({"turn", {"b"}}), std::vector<std::string>{"b"});
  EXPECT_FALSE(split->effects.contains("polish"));
  EXPECT_EQ(solve(testing::make_task(kDomain, kProblem), {}).kind, model::OutcomeKind::Infeasible);
  std::string negated = kDomain;
  negated.replace(negated.find("(can-turn ?x))"), 14, "(not (can-turn ?x)))");
  const auto refused = split_outside(testing::make_task(negated, kProblem), {"can-turn"});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error()[0].code, "P0119");
  EXPECT_EQ(refused.error()[0].where.line, 6u);
}

TEST(OutsideTask, WhenBeginningsAreForbidden_ThenExactlyTheOtherPlansAreFound) {
  const auto split = split_outside(testing::make_task(kDomain, kProblem), {"can-turn", "is-turned"});
  ASSERT_TRUE(split);
  EXPECT_EQ(all_plans(split->task, {}).size(), 24u);
  const model::GroundAction turn_a{"turn", {"a"}}, polish_a{"polish", {"a"}}, turn_b{"turn", {"b"}},
      polish_b{"polish", {"b"}};
  // Four places for the first action: 6 plans begin with it, 2 with a certain pair.
  const auto others =
      all_plans(split->task, {{{turn_a}}, {{polish_b, turn_b}}, {{polish_b, turn_b, turn_a}}});
  EXPECT_EQ(others.size(), 16u);
  for (const std::string& each : others) {
    EXPECT_FALSE(each.starts_with("(turn a)")) << each;
    EXPECT_FALSE(each.starts_with("(polish b)(turn b)")) << each;
  }
  // About b, whatever happens to a in between: half of them have the other order.
  const auto ordered = all_plans(split->task, {{{polish_b, turn_b}, "b"}});
  EXPECT_EQ(ordered.size(), 12u);
  for (const std::string& each : ordered) EXPECT_LT(each.find("(turn b)"), each.find("(polish b)")) << each;
  EXPECT_EQ(all_plans(split->task, {{{turn_b}, "b"}, {{polish_b}, "b"}}).size(), 0u);
}

}  // namespace
}  // namespace stepwright::pddl
