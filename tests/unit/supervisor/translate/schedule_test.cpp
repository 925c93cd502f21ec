#include "supervisor/translate/schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "supervisor/translate/plan_graph.h"
#include "tests/unit/supervisor/translate/bench_run.h"

namespace stepwright::translate {
namespace {

TEST(Schedule, WhenActionsAreOrdered_ThenEachStartsWhenTheLastBeforeItEnds) {
  const Binding binding = testing::bench_binding();
  const auto run = testing::bench_run({"(load v1 f1 level8)", "(move v1 f1 a1)"});
  const auto made = schedule(run, binding, false);
  ASSERT_TRUE(made);
  EXPECT_DOUBLE_EQ(made->actions[0].start_s, 1.5);
  EXPECT_DOUBLE_EQ(made->actions[0].finish_s, 1.5 + 0.4 + 8 * 1.3 + 1.5);
  EXPECT_DOUBLE_EQ(made->actions[1].start_s, made->actions[0].finish_s);
  EXPECT_DOUBLE_EQ(made->actions[1].finish_s, made->actions[1].start_s + 0.5 + 4.1);
  EXPECT_DOUBLE_EQ(made->makespan_s, made->actions[1].finish_s + 2.0);
}

TEST(Schedule, WhenPlanHasParallelParts_ThenItIsShorterThanTheSequence) {
  const Binding binding = testing::bench_binding();
  const auto run = testing::bench_run(testing::metric_ff_plan());
  const auto parallel = schedule(run, binding, false);
  const auto sequential = schedule(run, binding, true);
  ASSERT_TRUE(parallel && sequential);
  EXPECT_LT(parallel->makespan_s, 0.9 * sequential->makespan_s);
  double sum = 1.5 + 2.0;
  for (const ScheduledAction& action : sequential->actions) sum += action.finish_s - action.start_s;
  EXPECT_NEAR(sequential->makespan_s, sum, 1e-9);
  for (const model::Ordering& edge : *run.orderings) {
    EXPECT_LE(parallel->actions[edge.before].finish_s, parallel->actions[edge.after].start_s);
  }
}

TEST(Schedule, WhenTheCountedFluentIsUnknown_ThenFails) {
  const Binding binding = testing::bench_binding();
  auto run = testing::bench_run({"(move v1 f1 a1)"});
  run.actions[0].before.fluents.erase("(distance f1 a1)");
  const auto made = schedule(run, binding, false);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().front().code, "T0003");
}

TEST(Schedule, WhenAnActionHasTimeToSpare_ThenItIsNotCriticalAndTheReasonsAreNamed) {
  const Binding binding = testing::bench_binding();
  const auto made = schedule(testing::bench_run(testing::metric_ff_plan()), binding, false);
  ASSERT_TRUE(made);
  const auto critical = [](const ScheduledAction& action) { return action.critical(); };
  EXPECT_TRUE(std::any_of(made->actions.begin(), made->actions.end(), critical));
  EXPECT_FALSE(std::all_of(made->actions.begin(), made->actions.end(), critical));
  for (const ScheduledAction& action : made->actions) {
    EXPECT_GE(action.slack_s(), -1e-9);
    EXPECT_NEAR(action.latest_finish_s - action.latest_start_s, action.finish_s - action.start_s, 1e-9);
  }
  ASSERT_FALSE(made->links.empty());
  const ScheduleLink& first = made->links.front();  // load, then move
  EXPECT_EQ(first.kind, LinkKind::Threat);
  for (const ScheduleLink& link : made->links) EXPECT_FALSE(link.what.empty());
}

// Jobs of one or two machines; actions of one machine cannot run together.
struct Shop {
  Binding binding;
  model::PlannedRun run;
};

Shop random_shop(std::mt19937& random) {
  const auto pick = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
  std::string text = "[tags]\nm0 = { address = \"%QX0.0\" }\nm1 = { address = \"%QX0.1\" }\n";
  std::string actions;
  Shop shop;
  shop.run.orderings.emplace();
  for (std::size_t j = 0; j < 5; ++j) {
    const std::string name = "t" + std::to_string(j);
    text += "in" + std::to_string(j) + " = { address = \"%IX0." + std::to_string(j) + "\" }\n";
    actions += "[[facts]]\nfact = \"(finished " + name + ")\"\ntag = \"in" + std::to_string(j) + "\"\n";
    actions += "[[actions]]\naction = \"(work " + name + ")\"\ntimeout_s = 99\noutputs = [\"m" +
               std::to_string(pick(2)) + "\"]\nuntil = { fact = \"(finished " + name +
               ")\" }\nduration = { fixed_s = " + std::to_string(1 + pick(9)) + " }\n";
    model::PlannedAction planned;
    planned.action = {"work", {name}};
    for (std::size_t i = 0; i < j; ++i) {
      if (pick(4) == 0) shop.run.orderings->push_back({i, j});
    }
    shop.run.actions.push_back(std::move(planned));
  }
  auto binding = read_binding(text + actions, "shop.toml");
  if (!binding) throw std::runtime_error(to_string(binding.error()));
  shop.binding = std::move(*binding);
  return shop;
}

// The run in another order of its list.
model::PlannedRun reordered(const model::PlannedRun& run, const std::vector<std::size_t>& order) {
  model::PlannedRun other;
  std::vector<std::size_t> place(order.size());
  for (std::size_t n = 0; n < order.size(); ++n) {
    place[order[n]] = n;
    other.actions.push_back(run.actions[order[n]]);
  }
  other.orderings.emplace();
  for (const model::Ordering& edge : *run.orderings) {
    other.orderings->push_back({place[edge.before], place[edge.after]});
  }
  return other;
}

bool respects(const model::PlannedRun& run) {
  return std::all_of(run.orderings->begin(), run.orderings->end(),
                     [](const model::Ordering& edge) { return edge.before < edge.after; });
}

TEST(Schedule, WhenMachinesAreShared_ThenTheOrderIsTheBestOfAllOrders) {
  std::mt19937 random(11);
  int improved = 0;
  for (int round = 0; round < 60; ++round) {
    const Shop shop = random_shop(random);
    std::vector<std::size_t> order = {0, 1, 2, 3, 4};
    double best = 1e9;
    do {
      const auto other = reordered(shop.run, order);
      if (respects(other)) best = std::min(best, schedule(other, shop.binding, false)->makespan_s);
    } while (std::next_permutation(order.begin(), order.end()));
    const auto chosen = makespan_order(shop.run, shop.binding);
    ASSERT_TRUE(chosen);
    const auto other = reordered(shop.run, *chosen);
    ASSERT_TRUE(respects(other)) << round;
    const auto made = schedule(other, shop.binding, false);
    EXPECT_NEAR(made->makespan_s, best, 1e-6) << round;
    improved += made->makespan_s < schedule(shop.run, shop.binding, false)->makespan_s - 1e-6 ? 1 : 0;
    for (const ScheduleLink& link : made->links) {
      EXPECT_EQ(link.what.size(), link.kind == LinkKind::Resource ? 1u : 0u);
    }
  }
  EXPECT_GT(improved, 5);
}

}  // namespace
}  // namespace stepwright::translate
