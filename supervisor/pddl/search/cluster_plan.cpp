#include "supervisor/pddl/search/cluster_plan.h"

#include "supervisor/pddl/search/plan_runner.h"

namespace stepwright::pddl {
namespace {

// What an operator reads and writes: facts, then variables.
struct Touched {
  std::vector<int> reads, writes;
};

void add_reads(const GroundExpression& expression, int facts, std::vector<int>& reads) {
  for_each_variable(expression, [&](int v) { reads.push_back(facts + v); });
}

void add_reads(const Condition& condition, int facts, std::vector<int>& reads) {
  for (const int literal : condition.literals) reads.push_back(literal / 2);
  for (const Comparison& comparison : condition.comparisons) add_reads(comparison.difference, facts, reads);
  for (const auto& options : condition.choices) {
    for (const Condition& option : options) add_reads(option, facts, reads);
  }
}

Touched touched_by(const GroundTask& task, int op) {
  const GroundOperator& whole = task.operators[static_cast<std::size_t>(op)];
  const int facts = static_cast<int>(task.facts.size());
  Touched touched;
  add_reads(whole.precondition, facts, touched.reads);
  for (const GroundEffect& effect : whole.effects) {
    add_reads(effect.when, facts, touched.reads);
    add_reads(effect.cost, facts, touched.reads);
    touched.writes.insert(touched.writes.end(), effect.adds.begin(), effect.adds.end());
    touched.writes.insert(touched.writes.end(), effect.deletes.begin(), effect.deletes.end());
    for (const NumericEffect& numeric : effect.numeric) {
      touched.writes.push_back(facts + numeric.variable);
      add_reads(numeric.amount, facts, touched.reads);
    }
  }
  return touched;
}

// For every operator of the plan those that it must come after, by position.
std::vector<std::vector<std::size_t>> orderings(const GroundTask& task, const std::vector<int>& plan) {
  const std::size_t places = task.facts.size() + task.variables.size();
  std::vector<int> writer(places, -1);
  std::vector<std::vector<std::size_t>> readers(places), after(plan.size());
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const Touched touched = touched_by(task, plan[i]);
    for (const int place : touched.reads) {
      const auto p = static_cast<std::size_t>(place);
      if (writer[p] >= 0) after[i].push_back(static_cast<std::size_t>(writer[p]));
      readers[p].push_back(i);
    }
    for (const int place : touched.writes) {
      const auto p = static_cast<std::size_t>(place);
      if (writer[p] >= 0 && static_cast<std::size_t>(writer[p]) != i)
        after[i].push_back(static_cast<std::size_t>(writer[p]));
      for (const std::size_t reader : readers[p]) {
        if (reader != i) after[i].push_back(reader);
      }
      readers[p].clear();
      writer[p] = static_cast<int>(i);
    }
  }
  return after;
}

}  // namespace

// Always goes on with what the operator placed last has set free, if there is any.
std::vector<int> cluster_plan(const StateSpace& space, const std::vector<int>& plan) {
  if (!space.task().axioms.empty()) return plan;
  const auto after = orderings(space.task(), plan);
  std::vector<std::vector<std::size_t>> before(plan.size());
  std::vector<std::size_t> missing(plan.size(), 0);
  for (std::size_t i = 0; i < plan.size(); ++i) {
    missing[i] = after[i].size();
    for (const std::size_t earlier : after[i]) before[earlier].push_back(i);
  }
  std::vector<int> order;
  std::vector<std::size_t> ready;
  for (std::size_t i = plan.size(); i > 0; --i) {
    if (missing[i - 1] == 0) ready.push_back(i - 1);
  }
  while (!ready.empty()) {
    const std::size_t next = ready.back();
    ready.pop_back();
    order.push_back(plan[next]);
    for (auto later = before[next].rbegin(); later != before[next].rend(); ++later) {
      if (--missing[*later] == 0) ready.push_back(*later);
    }
  }
  return cost_of_plan(space, order) < kInfinity ? order : plan;
}

}  // namespace stepwright::pddl
