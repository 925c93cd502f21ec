#include "supervisor/pddl/search/pruning/operator_footprint.h"

#include <algorithm>

namespace stepwright::pddl {
namespace {

void make_unique(std::vector<int>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

OperatorFootprints::OperatorFootprints(const StateSpace& space)
    : task_(space.task()),
      domains_(space.domains()),
      prints_(task_.operators.size()),
      adders_(task_.facts.size()),
      deleters_(task_.facts.size()),
      fact_readers_(task_.facts.size()),
      askers_(2 * task_.facts.size()),
      writers_(task_.variables.size()),
      readers_(task_.variables.size()),
      comparers_(task_.variables.size()),
      seen_(task_.operators.size(), 0) {
  for (std::size_t i = 0; i < prints_.size(); ++i) {
    collect(task_.operators[i], prints_[i]);
    enter(static_cast<int>(i));
  }
}

void OperatorFootprints::read(const GroundExpression& expression, Footprint& print) const {
  for_each_variable(expression, [&](int v) { print.read_variables.push_back(v); });
}

void OperatorFootprints::read(const Condition& condition, Footprint& print) const {
  for (const int literal : condition.literals) print.read_facts.push_back(literal / 2);
  for (const Comparison& comparison : condition.comparisons) read(comparison.difference, print);
  for (const auto& options : condition.choices) {
    for (const Condition& option : options) read(option, print);
  }
}

void OperatorFootprints::collect(const GroundOperator& op, Footprint& print) const {
  for (const auto& options : op.precondition.choices) {
    for (const Condition& option : options) read(option, print);
  }
  for (const int literal : op.precondition.literals) {
    if (literal % 2 == 0) print.values.emplace_back(domains_.variable_of(literal / 2), literal / 2);
  }
  std::sort(print.values.begin(), print.values.end());
  std::vector<int> stays;  // an effect of the operator makes it true in any case
  for (const GroundEffect& effect : op.effects) {
    read(effect.when, print);
    read(effect.cost, print);
    print.adds.insert(print.adds.end(), effect.adds.begin(), effect.adds.end());
    if (effect.when.always()) stays.insert(stays.end(), effect.adds.begin(), effect.adds.end());
    for (const NumericEffect& numeric : effect.numeric) {
      read(numeric.amount, print);
      const bool grows = numeric.kind == ChangeKind::Increase, shrinks = numeric.kind == ChangeKind::Decrease;
      const Interval amount = evaluate_interval(numeric.amount, task_.bounds);
      print.writes.push_back({numeric.variable, grows || shrinks, shrinks ? -amount : amount});
    }
  }
  for (const GroundEffect& effect : op.effects) {
    for (const int fact : effect.deletes) {
      if (std::find(stays.begin(), stays.end(), fact) == stays.end()) print.deletes.push_back(fact);
    }
  }
  make_unique(print.adds);
  make_unique(print.deletes);
  make_unique(print.read_facts);
  make_unique(print.read_variables);
}

void OperatorFootprints::enter(int op) {
  const auto put = [op](std::vector<std::vector<int>>& lists, int index) {
    std::vector<int>& list = lists[static_cast<std::size_t>(index)];
    if (list.empty() || list.back() != op) list.push_back(op);
  };
  const Footprint& print = this->print(op);
  for (const int fact : print.adds) put(adders_, fact);
  for (const int fact : print.deletes) put(deleters_, fact);
  for (const int fact : print.read_facts) put(fact_readers_, fact);
  for (const int variable : print.read_variables) put(readers_, variable);
  for (const Write& write : print.writes) put(writers_, write.variable);
  const Condition& asked = ground(op).precondition;
  for (const int literal : asked.literals) put(askers_, literal);
  for (const Comparison& comparison : asked.comparisons) {
    for_each_variable(comparison.difference, [&](int v) { put(comparers_, v); });
  }
}

// May the writer bring the comparison nearer to holding?
bool OperatorFootprints::helps(int writer, const Comparison& comparison) const {
  const bool up = comparison.relation == Relation::Greater || comparison.relation == Relation::GreaterEqual;
  const bool both = comparison.relation == Relation::Equal;
  for (const Write& write : print(writer).writes) {
    bool reads = false;
    for_each_variable(comparison.difference, [&](int v) { reads = reads || v == write.variable; });
    if (!reads) continue;
    if (!write.additive || !comparison.difference.linear() || write.change.empty()) return true;
    const auto& terms = comparison.difference.terms;
    const auto term = std::find_if(terms.begin(), terms.end(),
                                   [&](const LinearTerm& t) { return t.variable == write.variable; });
    const Interval change = Interval::point(term->coefficient) * write.change;
    if ((up || both) && change.high > 0.0) return true;
    if ((!up || both) && change.low < 0.0) return true;
  }
  return false;
}

// What brings the opposite nearer.
bool OperatorFootprints::hurts(int writer, const Comparison& comparison) const {
  return helps(writer, {comparison.difference, opposite(comparison.relation)});
}

void OperatorFootprints::add_achievers(const Comparison& comparison, std::vector<int>& operators) const {
  for_each_variable(comparison.difference, [&](int v) {
    for (const int op : writers_[static_cast<std::size_t>(v)]) {
      if (helps(op, comparison)) operators.push_back(op);
    }
  });
}

void OperatorFootprints::add_achievers(const std::vector<Condition>& choice,
                                       std::vector<int>& operators) const {
  for (const Condition& option : choice) {
    for (const int literal : option.literals) {
      operators.insert(operators.end(), achievers(literal).begin(), achievers(literal).end());
    }
    for (const Comparison& comparison : option.comparisons) add_achievers(comparison, operators);
    for (const auto& inner : option.choices) add_achievers(inner, operators);
  }
}

// Do the preconditions ask for different values of one variable?
bool OperatorFootprints::never_meet(const Footprint& a, const Footprint& b) const {
  auto i = a.values.begin();
  auto j = b.values.begin();
  while (i != a.values.end() && j != b.values.end()) {
    if (i->first == j->first && i->second != j->second) return true;
    (*i < *j ? i : j)++;
  }
  return false;
}

void OperatorFootprints::add(int op, int other) {
  std::uint32_t& seen = seen_[static_cast<std::size_t>(other)];
  if (other == op || seen == call_) return;
  seen = call_;
  if (!never_meet(print(op), print(other))) print(op).interfering.push_back(other);
}

void OperatorFootprints::add(int op, const std::vector<int>& others) {
  for (const int other : others) add(op, other);
}

// Those that what the operator writes matters to.
void OperatorFootprints::find_disturbed(int op) {
  for (const int fact : print(op).adds) {
    add(op, askers_[2 * static_cast<std::size_t>(fact) + 1]);
    add(op, fact_readers_[static_cast<std::size_t>(fact)]);
    add(op, deleters_[static_cast<std::size_t>(fact)]);
  }
  for (const int fact : print(op).deletes) {
    add(op, askers_[2 * static_cast<std::size_t>(fact)]);
    add(op, fact_readers_[static_cast<std::size_t>(fact)]);
    add(op, adders_[static_cast<std::size_t>(fact)]);
  }
  for (const Write& write : print(op).writes) {
    const auto variable = static_cast<std::size_t>(write.variable);
    add(op, readers_[variable]);
    for (const int other : writers_[variable]) {
      const auto& writes = print(other).writes;
      const bool commute = write.additive && std::all_of(writes.begin(), writes.end(), [&](const Write& w) {
                             return w.variable != write.variable || w.additive;
                           });
      if (!commute) add(op, other);
    }
    for (const int other : comparers_[variable]) {
      for (const Comparison& comparison : ground(other).precondition.comparisons) {
        if (hurts(op, comparison)) add(op, other);
      }
    }
  }
}

// Those whose writes matter to the operator.
void OperatorFootprints::find_disturbing(int op) {
  for (const int literal : ground(op).precondition.literals) add(op, achievers(literal ^ 1));
  for (const int fact : print(op).read_facts) {
    add(op, adders_[static_cast<std::size_t>(fact)]);
    add(op, deleters_[static_cast<std::size_t>(fact)]);
  }
  for (const int variable : print(op).read_variables) add(op, writers_[static_cast<std::size_t>(variable)]);
  for (const Comparison& comparison : ground(op).precondition.comparisons) {
    for_each_variable(comparison.difference, [&](int v) {
      for (const int other : writers_[static_cast<std::size_t>(v)]) {
        if (hurts(other, comparison)) add(op, other);
      }
    });
  }
}

const std::vector<int>& OperatorFootprints::interfering(int op) {
  Footprint& print = this->print(op);
  if (!print.known) {
    print.known = true;
    ++call_;
    find_disturbed(op);
    find_disturbing(op);
    print.interfering.shrink_to_fit();
    interfering_entries_ += print.interfering.size();
  }
  return print.interfering;
}

}  // namespace stepwright::pddl
