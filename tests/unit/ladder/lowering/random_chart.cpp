#include "tests/unit/ladder/lowering/random_chart.h"

#include <algorithm>
#include <string>

namespace stepwright::lowering {
namespace {

using graphic::ActionBlock;
using graphic::Condition;
using graphic::Qualifier;
using graphic::StepId;

int pick(std::mt19937& random, int count) {
  return static_cast<int>(random() % static_cast<unsigned>(count));
}

std::vector<StepId> some_steps(std::mt19937& random, std::size_t steps) {
  std::vector<StepId> all;
  for (std::size_t i = 0; i < steps; ++i) all.push_back(StepId(static_cast<std::uint32_t>(i)));
  std::shuffle(all.begin(), all.end(), random);
  const int roll = pick(random, 10);
  const std::size_t count = roll < 6 ? 1 : roll < 9 ? 2 : 3;
  all.resize(std::min(count, all.size()));
  return all;
}

Condition condition(std::mt19937& random, std::size_t steps, int depth) {
  const std::string step = "S" + std::to_string(pick(random, static_cast<int>(steps)));
  const int roll = pick(random, depth > 0 ? 10 : 7);
  if (roll < 3) return graphic::contact("i" + std::to_string(pick(random, 4)), pick(random, 2) == 0);
  if (roll == 3) {
    return graphic::compare("n" + std::to_string(pick(random, 2)),
                            static_cast<graphic::CompareOp>(pick(random, 6)),
                            std::to_string(pick(random, 5)));
  }
  if (roll == 4) return graphic::contact(step + ".X", pick(random, 2) == 0);
  if (roll == 5) {
    return graphic::compare(step + ".T", graphic::CompareOp::GreaterEqual,
                            "T#" + std::to_string(10 * pick(random, 6)) + "ms");
  }
  if (roll == 6) return graphic::always();
  std::vector<Condition> children;
  for (int i = 0; i < 2 + pick(random, 2); ++i) children.push_back(condition(random, steps, depth - 1));
  return roll < 9 ? graphic::any(std::move(children)) : graphic::all(std::move(children));
}

std::vector<ActionBlock> action_blocks(std::mt19937& random) {
  std::vector<ActionBlock> blocks;
  for (int i = pick(random, 4); i > 0; --i) {
    ActionBlock block;
    block.qualifier = static_cast<Qualifier>(pick(random, 11));
    const int target = pick(random, 6);
    block.target = target < 4 ? "o" + std::to_string(target) : "COUNT" + std::to_string(target - 4);
    if (graphic::needs_duration(block.qualifier)) {
      block.duration = "T#" + std::to_string(10 * (1 + pick(random, 4))) + "ms";
    }
    blocks.push_back(block);
  }
  return blocks;
}

// Of steps that transitions connect one is initial.
void keep_one_initial_step_in_each_network(graphic::SfcChart& chart) {
  std::vector<std::uint32_t> network(chart.steps.size());
  for (std::uint32_t i = 0; i < network.size(); ++i) network[i] = i;
  const auto join = [&](StepId a, StepId b) {
    const std::uint32_t from = network[a.value];
    const std::uint32_t to = network[b.value];
    std::replace(network.begin(), network.end(), from, to);
  };
  for (const graphic::Transition& each : chart.transitions) {
    for (const StepId id : each.sources) join(id, each.sources.front());
    for (const StepId id : each.targets) join(id, each.sources.front());
  }
  for (std::size_t i = 0; i < network.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      if (network[k] == network[i] && chart.steps[k].initial) chart.steps[i].initial = false;
  }
}

}  // namespace

graphic::Pou random_pou(std::mt19937& random) {
  graphic::SfcChart chart;
  const std::size_t steps = 2 + static_cast<std::size_t>(pick(random, 6));
  for (std::size_t i = 0; i < steps; ++i) {
    graphic::Step step;
    step.name = "S" + std::to_string(i);
    step.initial = i == 0 || pick(random, 6) == 0;
    step.actions = action_blocks(random);
    chart.steps.push_back(std::move(step));
  }
  for (int i = 1 + pick(random, 10); i > 0; --i) {
    graphic::Transition transition;
    if (pick(random, 4) != 0) transition.name = "T" + std::to_string(i);
    transition.sources = some_steps(random, steps);
    transition.targets = some_steps(random, steps);
    transition.condition = condition(random, steps, 2);
    transition.priority = pick(random, 3);
    chart.transitions.push_back(std::move(transition));
  }
  keep_one_initial_step_in_each_network(chart);
  // With and without the flags Q of the actions, which without final scan decides how they are lowered.
  chart.final_scan = pick(random, 2) == 0;
  const bool flags = pick(random, 2) == 0;
  chart.actions = {{"COUNT0", std::string("c0 := c0 + 1;") + (flags ? " q0 := COUNT0.Q;" : "")},
                   {"COUNT1", std::string("c1 := c1 + 1;") + (flags ? " q1 := COUNT1.Q;" : "")}};

  graphic::Pou pou;
  pou.name = "main";
  for (const char* name : {"i0", "i1", "i2", "i3", "o0", "o1", "o2", "o3", "q0", "q1"})
    pou.variables.push_back({name, "BOOL"});
  for (const char* name : {"n0", "n1", "c0", "c1"}) pou.variables.push_back({name, "INT"});
  pou.body = std::move(chart);
  return pou;
}

}  // namespace stepwright::lowering
