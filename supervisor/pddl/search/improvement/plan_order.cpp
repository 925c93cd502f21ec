#include "supervisor/pddl/search/improvement/plan_order.h"

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

}  // namespace

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

void PlanOrder::connect(std::vector<std::vector<Word>>& sets, std::size_t from, std::size_t to) {
  std::vector<Word>& set = sets[from];
  for (std::size_t w = 0; w < words_; ++w) set[w] |= sets[to][w];
  set[to >> 6] |= Word{1} << (to & 63);
}

PlanOrder::PlanOrder(const GroundTask& task, const std::vector<int>& plan)
    : words_((plan.size() + 63) / 64),
      neighbours_(plan.size()),
      before_(plan.size(), std::vector<Word>(words_, 0)),
      behind_(plan.size(), std::vector<Word>(words_, 0)) {
  const auto after = orderings(task, plan);
  for (std::size_t i = 0; i < plan.size(); ++i) {
    for (const std::size_t earlier : after[i]) {
      connect(before_, i, earlier);
      neighbours_[i].push_back(earlier);
      neighbours_[earlier].push_back(i);
    }
  }
  for (std::size_t i = plan.size(); i > 0; --i) {
    for (const std::size_t earlier : after[i - 1]) connect(behind_, earlier, i - 1);
  }
}

std::vector<std::size_t> PlanOrder::closure(const std::vector<std::size_t>& chosen) const {
  std::vector<Word> before(words_, 0), behind(words_, 0), own(words_, 0);
  for (const std::size_t c : chosen) {
    for (std::size_t w = 0; w < words_; ++w) {
      before[w] |= before_[c][w];
      behind[w] |= behind_[c][w];
    }
    own[c >> 6] |= Word{1} << (c & 63);
  }
  std::vector<std::size_t> closed;
  for (std::size_t w = 0; w < words_; ++w) {
    for (Word bits = own[w] | (before[w] & behind[w]); bits != 0; bits &= bits - 1) {
      closed.push_back(64 * w + static_cast<std::size_t>(std::countr_zero(bits)));
    }
  }
  return closed;
}

GatheredPlan PlanOrder::gather(const std::vector<int>& plan, const std::vector<std::size_t>& closed) const {
  std::vector<Word> behind(words_, 0), own(words_, 0);
  for (const std::size_t c : closed) {
    for (std::size_t w = 0; w < words_; ++w) behind[w] |= behind_[c][w];
    own[c >> 6] |= Word{1} << (c & 63);
  }
  GatheredPlan gathered;
  std::vector<int> rest;
  const auto has = [](const std::vector<Word>& set, std::size_t i) { return (set[i >> 6] >> (i & 63)) & 1; };
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (has(own, i)) continue;
    (has(behind, i) ? rest : gathered.plan).push_back(plan[i]);
  }
  gathered.first = gathered.plan.size();
  for (const std::size_t c : closed) gathered.plan.push_back(plan[c]);
  gathered.last = gathered.plan.size();
  gathered.plan.insert(gathered.plan.end(), rest.begin(), rest.end());
  return gathered;
}

}  // namespace stepwright::pddl
