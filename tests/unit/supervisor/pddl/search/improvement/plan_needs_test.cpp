// What the rest of a plan needs: enough, so that the rest runs wherever it is met, and no more than that.

#include "supervisor/pddl/search/improvement/plan_needs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/planner/solve.h"
#include "supervisor/pddl/search/control/plan_runner.h"
#include "supervisor/pddl/search/improvement/plan_order.h"
#include "tests/support/pddl/random_task.h"
#include "tests/support/pddl/random_walk.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

std::vector<int> first_plan(const Task& task, const GroundTask& ground) {
  Options options;
  options.first_only = true;
  const model::Outcome outcome = solve(task, options);
  std::vector<int> operators;
  if (!outcome.plan) return operators;
  for (const model::GroundAction& action : outcome.plan->actions) {
    for (std::size_t i = 0; i < ground.operators.size(); ++i) {
      if (action_of(ground, ground.operators[i]) == action) operators.push_back(static_cast<int>(i));
    }
  }
  return operators;
}

struct Rest {
  bool runs = true;  // and meets the goal
  double cost = 0.0;
};

Rest run_from(const StateSpace& space, std::vector<Word> state, const std::vector<int>& plan,
              std::size_t from) {
  Rest rest;
  std::vector<Word> next(space.words());
  for (std::size_t i = from; i < plan.size(); ++i) {
    const auto& op = space.task().operators[static_cast<std::size_t>(plan[i])];
    if (!space.holds(op.precondition, state.data()) ||
        !space.apply(plan[i], state.data(), next.data(), rest.cost)) {
      return {false, 0.0};
    }
    state.swap(next);
  }
  rest.runs = space.goal(state.data());
  rest.cost += space.evaluate(space.task().potential, state.data());
  return rest;
}

bool met(const StateSpace& space, const PlanNeeds& needs, const Word* own, const Word* state) {
  const std::vector<int> literals = needs.literals();
  const std::vector<Comparison> comparisons = needs.comparisons(own);
  return std::all_of(literals.begin(), literals.end(), [&](int l) { return space.literal(state, l); }) &&
         std::all_of(comparisons.begin(), comparisons.end(),
                     [&](const Comparison& c) { return space.holds(c, state); });
}

// How many other states met the needs of some rest of the plan.
int judge(const Task& task, std::uint32_t seed) {
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const StateSpace space(ground);
  const std::vector<int> plan = first_plan(task, ground);
  if (plan.empty()) return 0;
  std::vector<std::vector<Word>> states = {space.initial()};
  for (const int op : plan) {
    double cost = 0.0;
    states.emplace_back(space.words());
    EXPECT_TRUE(space.apply(op, states[states.size() - 2].data(), states.back().data(), cost));
  }
  int others = 0;
  PlanNeeds needs(space, states.back().data());
  for (std::size_t i = plan.size();; --i) {
    const std::vector<Word>& own = states[i];
    EXPECT_TRUE(met(space, needs, own.data(), own.data()));
    const Rest truth = run_from(space, own, plan, i);
    testing::random_walk(space, seed, 150, [&](const std::vector<Word>& state) {
      if (state == own || !met(space, needs, own.data(), state.data())) return;
      ++others;
      const Rest rest = run_from(space, state, plan, i);
      EXPECT_TRUE(rest.runs);
      EXPECT_LE(rest.cost, truth.cost + 1e-6);
    });
    if (i == 0) return others;
    needs.prepend(plan[i - 1], states[i - 1].data());
  }
}

TEST(PlanNeeds, WhenAnotherStateMeetsThem_ThenTheRestRunsAndCostsNoMore) {
  int others = judge(testing::bench_task(), 1);
  others += judge(testing::lamps_task("(and (forall (?l - lamp) (on ?l)) (powered))"), 1);
  for (std::uint32_t seed = 300; seed < 340; ++seed) {
    const testing::RandomTask random = testing::random_task(seed);
    SCOPED_TRACE(random.domain + random.problem);
    others += judge(random.task, seed);
  }
  EXPECT_GT(others, 100);
}

TEST(PlanNeeds, WhenTheRestOnlyAddsToANumber_ThenItNeedNotBeTheSame) {
  const Task task = testing::counter_task("(>= (n) 6)");
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const StateSpace space(ground);
  const auto three = std::find_if(ground.operators.begin(), ground.operators.end(), [&](const auto& op) {
    return model::to_string(action_of(ground, op)) == "(three)";
  });
  const int op = static_cast<int>(three - ground.operators.begin());
  std::vector<Word> state = space.initial(), after(space.words());
  double cost = 0.0;
  state[space.fact_words()] = std::bit_cast<Word>(3.0);
  ASSERT_TRUE(space.apply(op, state.data(), after.data(), cost));
  PlanNeeds needs(space, after.data());
  needs.prepend(op, state.data());
  for (const double n : {2.0, 3.0, 50.0, 97.0, 98.0}) {
    std::vector<Word> other = state;
    other[space.fact_words()] = std::bit_cast<Word>(n);
    EXPECT_EQ(met(space, needs, state.data(), other.data()), n >= 3.0 && n <= 97.0) << n;
  }
}

// How long the plan is whose operators were gathered; 0: none that says much.
std::size_t judge_gathering(const Task& task, std::uint32_t seed) {
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const std::vector<int> plan = first_plan(task, ground);
  if (!ground.axioms.empty() || plan.size() < 3) return 0;
  const StateSpace space(ground);
  const PlanOrder order(ground, plan);
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const std::vector<std::size_t> closed = order.closure({i, (i * 7 + seed) % plan.size()});
    const GatheredPlan gathered = order.gather(plan, closed);
    EXPECT_EQ(gathered.plan.size(), plan.size());
    EXPECT_EQ(gathered.last - gathered.first, closed.size());
    for (std::size_t k = 0; k < closed.size() && gathered.first + k < gathered.plan.size(); ++k) {
      EXPECT_EQ(gathered.plan[gathered.first + k], plan[closed[k]]);
    }
    EXPECT_NEAR(cost_of_plan(space, gathered.plan), cost_of_plan(space, plan), 1e-6);
  }
  return plan.size();
}

TEST(PlanOrder, WhenOperatorsAreGathered_ThenThePlanCostsTheSameAndTheyStandTogether) {
  EXPECT_GT(judge_gathering(testing::bench_task(), 1), 10u);
  EXPECT_GT(judge_gathering(testing::logistics_task(6), 2), 10u);
  int plans = 0;
  for (std::uint32_t seed = 400; seed < 500; ++seed) {
    const testing::RandomTask random = testing::random_task(seed);
    SCOPED_TRACE(random.domain + random.problem);
    if (judge_gathering(random.task, seed) > 0) ++plans;
  }
  EXPECT_GT(plans, 4);
}

}  // namespace
}  // namespace stepwright::pddl
