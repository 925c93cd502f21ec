#include "supervisor/pddl/search/space/finite_domains.h"

#include <algorithm>

namespace stepwright::pddl {
namespace {

void renumber(std::vector<int>& facts, const std::vector<int>& place) {
  for (int& fact : facts) fact = place[static_cast<std::size_t>(fact)];
}

void renumber(Condition& condition, const std::vector<int>& place) {
  for (int& literal : condition.literals) {
    literal = 2 * place[static_cast<std::size_t>(literal / 2)] + literal % 2;
  }
  for (auto& options : condition.choices) {
    for (Condition& option : options) renumber(option, place);
  }
}

void renumber_facts(GroundTask& task, const std::vector<int>& place) {
  std::vector<Atom> facts(task.facts.size());
  std::vector<bool> initial(task.facts.size());
  for (std::size_t f = 0; f < task.facts.size(); ++f) {
    const auto to = static_cast<std::size_t>(place[f]);
    facts[to] = std::move(task.facts[f]);
    initial[to] = task.initial_facts[f];
  }
  task.facts = std::move(facts);
  task.initial_facts = std::move(initial);
  renumber(task.goal, place);
  for (GroundOperator& op : task.operators) {
    renumber(op.precondition, place);
    for (GroundEffect& effect : op.effects) {
      renumber(effect.when, place);
      renumber(effect.adds, place);
      renumber(effect.deletes, place);
    }
  }
  for (GroundAxiom& axiom : task.axioms) {
    axiom.fact = place[static_cast<std::size_t>(axiom.fact)];
    renumber(axiom.body, place);
  }
  for (FactGroup& group : task.groups) {
    renumber(group.facts, place);
    std::sort(group.facts.begin(), group.facts.end());
  }
  for (std::vector<int>& set : task.exclusive) {
    renumber(set, place);
    std::sort(set.begin(), set.end());
  }
}

bool derived(const GroundTask& task, const FactGroup& group) {
  return std::any_of(group.facts.begin(), group.facts.end(), [&](int f) { return f >= task.first_derived; });
}

}  // namespace

FiniteDomains::FiniteDomains(const GroundTask& task) : variable_of_(task.facts.size(), -1) {
  int next = 0;
  for (const FactGroup& group : task.groups) {
    const int count = static_cast<int>(group.facts.size());
    if (count < 2 || derived(task, group) || group.facts.front() != next ||
        group.facts.back() != next + count - 1) {
      continue;
    }
    std::fill_n(variable_of_.begin() + next, count, static_cast<int>(variables_.size()));
    variables_.push_back({next, count, !group.exactly_one});
    next += count;
  }
  for (; next < static_cast<int>(task.facts.size()); ++next) {
    variable_of_[static_cast<std::size_t>(next)] = static_cast<int>(variables_.size());
    variables_.push_back({next, 1, true});
  }
}

void arrange_by_groups(GroundTask& task) {
  std::stable_sort(task.groups.begin(), task.groups.end(),
                   [](const FactGroup& a, const FactGroup& b) { return a.facts.size() > b.facts.size(); });
  std::vector<int> place(task.facts.size(), -1);
  int next = 0;
  for (const FactGroup& group : task.groups) {
    if (group.facts.size() < 2 || derived(task, group)) continue;
    for (const int fact : group.facts) place[static_cast<std::size_t>(fact)] = next++;
  }
  for (int& p : place) {
    if (p < 0) p = next++;  // ascending, so that derived facts stay behind all others
  }
  renumber_facts(task, place);
}

}  // namespace stepwright::pddl
