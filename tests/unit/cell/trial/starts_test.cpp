#include "cell/trial/starts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cell/binding/ground_actions.h"
#include "runtime/ground/result/value_or_throw.h"

namespace stepwright::trial {
namespace {

// A dryer that is loaded twice: the second time it holds what was dried.
const std::string kDomain = R"pddl((define (domain grain)
  (:requirements :typing :numeric-fluents)
  (:types batch - object)
  (:predicates (never))
  (:functions (mass) (moisture) (barn) (tonnes ?a - batch) (batches))
  (:action load
    :parameters (?a - batch)
    :precondition (= (mass) 0)
    :effect (and (increase (mass) (tonnes ?a)) (increase (batches) 1)))
  (:action dry-it
    :parameters ()
    :precondition (and (> (mass) 0) (> (moisture) 14))
    :effect (assign (moisture) 14))
  (:action discharge
    :parameters ()
    :precondition (and (> (mass) 0) (<= (moisture) 14))
    :effect (and (increase (barn) (mass)) (assign (mass) 0)))
  (:action sweep
    :parameters ()
    :precondition (> (barn) 0)
    :effect (never))))pddl";
const std::string kProblem = R"pddl((define (problem harvest)
  (:domain grain)
  (:objects large - batch)
  (:init (= (mass) 0) (= (moisture) 22) (= (barn) 0) (= (tonnes large) 1) (= (batches) 0))
  (:goal (= (barn) 2))
  (:metric minimize (batches))))pddl";

std::vector<Start> starts_of(const std::string& name) {
  const auto task =
      result::value_or_throw(pddl::parse_task({"domain.pddl", kDomain}, {"problem.pddl", kProblem}));
  pddl::Options own;
  own.optimal = true;
  Starts starts(task, own, std::chrono::milliseconds(5'000));
  for (const pddl::GroundActionInfo& info : cell_binding::ground_actions(task, 100).actions)
    if (info.action.name == name) return starts.of(info);
  return {};
}

std::size_t count_of(const Start& start, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::count(start.before, name, &model::GroundAction::name));
}

TEST(Starts, WhenThePlanHasAnActionTwice_ThenBothPlacesAreStarts) {
  const std::vector<Start> starts = starts_of("load");
  ASSERT_EQ(starts.size(), 2u);
  EXPECT_TRUE(starts[0].before.empty());
  EXPECT_EQ(count_of(starts[1], "load"), 1u);
  EXPECT_EQ(count_of(starts[1], "dry-it"), 1u);
  EXPECT_EQ(count_of(starts[1], "discharge"), 1u);
}

TEST(Starts, WhenThePlanHasAnActionNowhere_ThenTheFirstStateInWhichItAppliesIsOne) {
  const std::vector<Start> starts = starts_of("sweep");
  ASSERT_FALSE(starts.empty());
  EXPECT_LE(starts.size(), 2u);
  EXPECT_EQ(count_of(starts.back(), "discharge"), 1u);
}

}  // namespace
}  // namespace stepwright::trial
