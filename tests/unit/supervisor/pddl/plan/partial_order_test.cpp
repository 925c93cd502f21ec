#include "supervisor/pddl/plan/partial_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "supervisor/pddl/action/ground_action.h"
#include "supervisor/pddl/plan/simulate.h"
#include "supervisor/pddl/planner/solve.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

using testing::bench_task;

// before[i][j]: i before j in the transitive closure.
std::vector<std::vector<bool>> closure(std::size_t count, const std::vector<model::Ordering>& orderings) {
  std::vector<std::vector<bool>> before(count, std::vector<bool>(count, false));
  for (const model::Ordering& o : orderings) before[o.before][o.after] = true;
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) {
        if (before[i][k] && before[k][j]) before[i][j] = true;
      }
    }
  }
  return before;
}

// A linearization that takes, among the actions that may come next, the one that `pick` chooses.
model::Plan linearize(const model::Plan& plan, const std::vector<model::Ordering>& orderings,
                      std::uint64_t seed) {
  model::Plan result;
  std::vector<bool> done(plan.actions.size(), false);
  for (std::size_t n = 0; n < plan.actions.size(); ++n) {
    std::vector<std::size_t> ready;
    for (std::size_t i = 0; i < plan.actions.size(); ++i) {
      const bool blocked = std::any_of(orderings.begin(), orderings.end(), [&](const model::Ordering& o) {
        return o.after == i && !done[o.before];
      });
      if (!done[i] && !blocked) ready.push_back(i);
    }
    seed = seed * 6364136223846793005ull + 1442695040888963407ull;
    const std::size_t chosen = ready[(seed >> 33) % ready.size()];
    done[chosen] = true;
    result.actions.push_back(plan.actions[chosen]);
  }
  return result;
}

model::Plan bench_plan() {
  Options options;
  options.optimal = true;
  return *solve(bench_task(), options).plan;
}

TEST(PartialOrder, WhenLinearizedAnyWay_ThenTheSameEndAndCost) {
  const Task task = bench_task();
  const model::Plan plan = bench_plan();
  const auto end = simulate(task, plan);
  bool reordered = false;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const model::Plan other = linearize(plan, *plan.orderings, seed);
    reordered = reordered || other.actions != plan.actions;
    const auto trace = simulate(task, other);
    ASSERT_TRUE(trace.has_value()) << result::to_string(trace.error());
    EXPECT_EQ(trace->states.back(), end->states.back());
    EXPECT_EQ(trace->cost.back(), end->cost.back());
  }
  EXPECT_TRUE(reordered);
}

TEST(PartialOrder, WhenACustomerIsServed_ThenBesideTheVehicle) {
  // In the paper's plan, complete_order (9) of a1 may run beside everything between the deliveries to a1 (3
  // and 12).
  const Task task = bench_task();
  model::Plan plan;
  plan.actions = {{"load", {"v1", "f1", "level8"}},   {"move", {"v1", "f1", "a1"}},
                  {"unload", {"v1", "a1", "level8"}}, {"complete_order", {"a1", "c1", "level7"}},
                  {"move", {"v1", "a1", "f1"}},       {"load", {"v1", "f1", "level2"}},
                  {"move", {"v1", "f1", "a1"}},       {"unload", {"v1", "a1", "level2"}}};
  const auto orderings = lift_partial_order(task, plan);
  ASSERT_TRUE(orderings.has_value());
  const auto before = closure(plan.actions.size(), *orderings);
  EXPECT_TRUE(before[2][3]);   // the delivery feeds the order
  EXPECT_FALSE(before[3][4]);  // the vehicle need not wait
  EXPECT_FALSE(before[3][6]);
  EXPECT_TRUE(before[3][7]);  // the next delivery changes the same level
  EXPECT_TRUE(before[4][5]);
}

TEST(PartialOrder, WhenReduced_ThenNoOrderingFollowsFromOthers) {
  const model::Plan plan = bench_plan();
  ASSERT_TRUE(plan.orderings.has_value());
  const std::vector<model::Ordering>& orderings = *plan.orderings;
  const auto whole = closure(plan.actions.size(), orderings);
  for (std::size_t i = 0; i < orderings.size(); ++i) {
    std::vector<model::Ordering> rest = orderings;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
    const auto without = closure(plan.actions.size(), rest);
    EXPECT_FALSE(without[orderings[i].before][orderings[i].after]);
    EXPECT_TRUE(whole[orderings[i].before][orderings[i].after]);
  }
}

// Steps need the one before, but for the last one, which needs two from the beginning.
TEST(PartialOrder, WhenThePlanIsLong_ThenExactlyTheOrderingsThatNothingImplies) {
  constexpr std::size_t kSteps = 150;
  std::string predicates, actions;
  model::Plan plan;
  std::vector<model::Ordering> expected;
  for (std::size_t i = 0; i < kSteps; ++i) {
    const std::string number = std::to_string(i);
    const bool last = i + 1 == kSteps;
    predicates += "(f" + number + ")";
    const std::string needs = i == 0 ? "()" : last ? "(and (f2) (f70))" : "(f" + std::to_string(i - 1) + ")";
    actions +=
        "(:action a" + number + " :parameters () :precondition " + needs + " :effect (f" + number + "))";
    plan.actions.push_back({"a" + number, {}});
    if (i > 0) expected.push_back({last ? 70 : i - 1, i});
  }
  std::sort(expected.begin(), expected.end(), [](const model::Ordering& a, const model::Ordering& b) {
    return a.before != b.before ? a.before < b.before : a.after < b.after;
  });
  const Task task = testing::make_task("(define (domain d) (:predicates " + predicates + ")" + actions + ")",
                                       "(define (problem p) (:domain d) (:init) (:goal (f149)))");
  const auto orderings = lift_partial_order(task, plan);
  ASSERT_TRUE(orderings);
  ASSERT_EQ(orderings->size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ((*orderings)[i].before, expected[i].before);
    EXPECT_EQ((*orderings)[i].after, expected[i].after);
  }
}

TEST(Simulate, WhenOnlyTheEndIsAsked_ThenItIsTheLastStateOfAllAndFailsAsThese) {
  const Task task = bench_task();
  model::Plan plan = *solve(task).plan;
  const auto trace = simulate(task, plan);
  const auto end = state_after(task, plan);
  ASSERT_TRUE(trace && end);
  EXPECT_TRUE(*end == trace->states.back());
  EXPECT_FALSE(*end == trace->states.front());
  std::reverse(plan.actions.begin(), plan.actions.end());
  const auto failed = state_after(task, plan);
  ASSERT_FALSE(failed);
  EXPECT_EQ(result::to_string(failed.error()), result::to_string(simulate(task, plan).error()));
}

TEST(PartialOrder, WhenAnActionIsUnknown_ThenItFails) {
  model::Plan plan;
  plan.actions = {{"fly", {"v1"}}};
  EXPECT_FALSE(lift_partial_order(bench_task(), plan).has_value());
}

TEST(GroundAction, WhenInspected_ThenConditionsReadsAndWrites) {
  const auto info = inspect_action(bench_task(), {"unload", {"v1", "a1", "level8"}});
  ASSERT_TRUE(info.has_value());
  ASSERT_EQ(info->preconditions.size(), 3u);
  EXPECT_EQ(info->preconditions[0].fact, "(is-at v1 a1)");
  const Requirement& capacity = info->preconditions[2];
  EXPECT_EQ(capacity.kind, RequirementKind::Comparison);
  EXPECT_EQ(capacity.relation, Relation::LessEqual);
  EXPECT_EQ(capacity.left.operands[0].fluent, "(level a1)");
  EXPECT_EQ(capacity.left.operands[1].constant, 8.0);  // (amount level8) never changes
  EXPECT_EQ(capacity.right.constant, 10.0);
  EXPECT_EQ(info->reads, (std::set<std::string>{"(is-at v1 a1)", "(lev v1)", "(level a1)"}));
  EXPECT_EQ(info->writes, (std::set<std::string>{"(lev v1)", "(level a1)"}));
  EXPECT_TRUE(info->counts.empty());
}

TEST(GroundAction, WhenOnlyTheMetricReadsAFluent_ThenItCounts) {
  const auto info = inspect_action(bench_task(), {"move", {"v1", "f1", "a1"}});
  EXPECT_EQ(info->counts, (std::set<std::string>{"(distance-travelled)", "(transport-cost)"}));
  EXPECT_EQ(info->preconditions.size(), 1u);
}

TEST(GroundAction, WhenStaticFactsForbidIt_ThenImpossible) {
  const auto info = inspect_action(bench_task(), {"complete_order", {"a1", "c2", "level10"}});
  ASSERT_TRUE(info.has_value());
  EXPECT_EQ(info->preconditions[0].kind, RequirementKind::Any);
  EXPECT_TRUE(info->preconditions[0].parts.empty());
}

TEST(GroundAction, WhenEffectsAreConditional_ThenTheirConditionsStand) {
  const auto info = inspect_action(testing::lamps_task("(on a)"), {"toggle", {"hall"}});
  ASSERT_TRUE(info.has_value());
  // The counter and, for the two lamps of the hall, one change each way.
  EXPECT_EQ(info->changes.size(), 5u);
  EXPECT_TRUE(info->changes[0].when.empty());
  EXPECT_EQ(info->changes[1].when.size(), 1u);
  EXPECT_EQ(info->reads, (std::set<std::string>{"(on b)", "(on c)", "(powered)"}));
}

}  // namespace
}  // namespace stepwright::pddl
