#include "supervisor/pddl/search/landmarks.h"

#include <gtest/gtest.h>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/lifted/lifted_state.h"
#include "supervisor/pddl/search/landmark_count.h"
#include "supervisor/pddl/solve.h"
#include "tests/unit/supervisor/pddl/random_task.h"
#include "tests/unit/supervisor/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

std::vector<int> operators_of(const GroundTask& ground, const model::Plan& plan) {
  std::vector<int> operators;
  for (const model::GroundAction& action : plan.actions) {
    for (std::size_t i = 0; i < ground.operators.size(); ++i) {
      if (action_of(ground, ground.operators[i]) == action) operators.push_back(static_cast<int>(i));
    }
  }
  return operators;
}

// Along a plan every landmark is reached, and at its end nothing is left to count.
void expect_on_every_plan(const Task& task) {
  Options options;
  options.first_only = true;
  const model::Outcome outcome = solve(task, options);
  if (!outcome.plan) return;
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  const Landmarks landmarks(relaxed, [] { return false; });
  EXPECT_GE(landmarks.size(), relaxed.goal().size() > 0 && ground.goal.choices.empty() ? 1u : 0u);
  const LandmarkCount count(relaxed, landmarks, std::vector<int>(ground.operators.size(), 1));
  std::vector<Word> state = space.initial(), next(space.words()), reached(count.words() + 1, 0);
  count.progress(state.data(), reached.data());
  for (const int op : operators_of(ground, *outcome.plan)) {
    double cost = 0.0;
    ASSERT_TRUE(space.apply(op, state.data(), next.data(), cost));
    state = next;
    count.progress(state.data(), reached.data());
  }
  for (std::size_t l = 0; l < landmarks.size(); ++l) {
    EXPECT_TRUE(bit(reached.data(), static_cast<int>(l))) << l;
  }
  EXPECT_EQ(count.estimate(state.data(), reached.data()), 0);
}

TEST(Landmarks, WhenAPlanIsExecuted_ThenItReachesThemAll) {
  expect_on_every_plan(testing::bench_task());
  expect_on_every_plan(testing::logistics_task(6));
  expect_on_every_plan(testing::lamps_task("(and (forall (?l - lamp) (on ?l)) (powered))"));
  for (std::uint32_t seed = 200; seed < 260; ++seed) {
    const testing::RandomTask random = testing::random_task(seed);
    SCOPED_TRACE(random.domain + random.problem);
    expect_on_every_plan(random.task);
  }
}

TEST(Landmarks, WhenATruckMustPassAPlace_ThenThePlaceIsOne) {
  const Task task = testing::logistics_task(4);
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  const Landmarks landmarks(relaxed, [] { return false; });
  bool on_the_way = false, carried = false;
  for (std::size_t l = 0; l < landmarks.size(); ++l) {
    const int literal = relaxed.literal_of(static_cast<std::size_t>(landmarks.atom(l)));
    const std::string name =
        fact_name(task.definition(), ground.facts[static_cast<std::size_t>(literal / 2)]);
    on_the_way = on_the_way || name == "(at t p3)";
    carried = carried || name == "(in k1 t)";
  }
  EXPECT_TRUE(on_the_way);
  EXPECT_TRUE(carried);
}

}  // namespace
}  // namespace stepwright::pddl
