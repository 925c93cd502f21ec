#include "supervisor/htn/plan/validate.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "supervisor/htn/plan/plan_json.h"

namespace stepwright::htn {
namespace {

using testing::HasSubstr;

const lisp::Source kDomain{"domain.hddl", R"((define (domain d)
  (:types car place)
  (:predicates (at ?c - car ?p - place) (road ?a ?b - place) (way ?c - car))
  (:functions (total-cost))
  (:task bring :parameters (?c - car ?p - place))
  (:method there :parameters (?c - car ?p - place) :task (bring ?c ?p)
    :precondition (at ?c ?p) :ordered-subtasks ())
  (:method on :parameters (?c - car ?a ?b ?p - place) :task (bring ?c ?p)
    :precondition (at ?c ?a) :ordered-subtasks (and (go ?c ?a ?b) (bring ?c ?p))
    :constraints (not (= ?a ?p)))
  (:action go :parameters (?c - car ?a ?b - place)
    :precondition (and (at ?c ?a) (road ?a ?b) (way ?c))
    :effect (and (not (at ?c ?a)) (at ?c ?b) (increase (total-cost) 2)))))"};
const lisp::Source kProblem{"problem.hddl", R"((define (problem p) (:domain d)
  (:objects c - car x y z - place)
  (:htn :parameters (?c - car) :subtasks (and (bring ?c z)))
  (:init (at c x) (road x y) (road y z)) (:goal (at c z))))"};
const std::set<std::string> kExternal = {"way"};

// x to y to z.
Plan good() {
  Plan plan;
  plan.binding = {"c"};
  plan.roots = {0};
  plan.steps = {1, 3};
  plan.cost = 4.0;
  plan.nodes = {{"bring", {"c", "z"}, "on", {"c", "x", "y", "z"}, {1, 2}},
                {"go", {"c", "x", "y"}, "", {}, {}},
                {"bring", {"c", "z"}, "on", {"c", "y", "z", "z"}, {3, 4}},
                {"go", {"c", "y", "z"}, "", {}, {}},
                {"bring", {"c", "z"}, "there", {"c", "z"}, {}}};
  return plan;
}

std::string judged(const Plan& plan) {
  const Validation result = validate(kDomain, kProblem, plan, kExternal);
  EXPECT_EQ(result.valid, result.reason.empty());
  return result.reason;
}

TEST(ValidateHtn, WhenAllIsRight_ThenThePlanIsValid) {
  EXPECT_EQ(judged(good()), "");
}

TEST(ValidateHtn, WhenAnythingIsWrong_ThenItIsTold) {
  Plan plan = good();
  plan.nodes[3].arguments[2] = "y";
  EXPECT_THAT(judged(plan), HasSubstr("not the subtask"));
  plan = good();
  plan.nodes[0].binding[2] = "z";
  plan.nodes[1].arguments[2] = "z";
  EXPECT_THAT(judged(plan), HasSubstr("precondition"));  // no road from x to z
  plan = good();
  plan.nodes[0].method = "there";
  EXPECT_THAT(judged(plan), HasSubstr("number of objects"));
  plan = good();
  plan.nodes[0].method = "fly";
  EXPECT_THAT(judged(plan), HasSubstr("no method"));
  plan = good();
  plan.nodes[4].binding = {"c", "y"};
  EXPECT_THAT(judged(plan), HasSubstr("not for this task"));
  plan = good();
  plan.steps = {1};
  EXPECT_THAT(judged(plan), HasSubstr("next step"));
  plan = good();
  plan.nodes[2].children = {3, 3};
  EXPECT_THAT(judged(plan), HasSubstr("not the subtask"));
  plan = good();
  plan.roots = {0, 0};
  EXPECT_THAT(judged(plan), HasSubstr("number of subtasks"));
  plan = good();
  plan.nodes.push_back(plan.nodes[4]);
  EXPECT_THAT(judged(plan), HasSubstr("under no task"));
  plan = good();
  plan.cost = 3.0;
  EXPECT_THAT(judged(plan), HasSubstr("costs"));
  plan = good();
  plan.binding = {"x"};
  EXPECT_THAT(judged(plan), HasSubstr("not of type"));
  plan = good();
  plan.nodes[0].children = {1, 77};
  EXPECT_THAT(judged(plan), HasSubstr("not there"));
}

TEST(ValidateHtn, WhenNobodyElseJudgesAPredicate_ThenItsConditionCounts) {
  EXPECT_FALSE(validate(kDomain, kProblem, good()).valid);
}

TEST(HtnPlan, WhenWritten_ThenTextAndJsonHaveTheTree) {
  EXPECT_THAT(print_plan(good()), HasSubstr("1 go c x y\n3 go c y z\nroot 0\n0 bring c z -> on 1 2\n"));
  EXPECT_THAT(print_plan(good()), HasSubstr("4 bring c z -> there\n<==\n"));
  const nlohmann::json json = to_json(good());
  EXPECT_EQ(json["plan"][0], "(go c x y)");
  EXPECT_EQ(json["tree"]["nodes"][2]["subtasks"][1], 4);
  EXPECT_EQ(json["plan_cost"], 4.0);
  EXPECT_EQ(actions_of(good()).actions.size(), 2u);
}

}  // namespace
}  // namespace stepwright::htn
