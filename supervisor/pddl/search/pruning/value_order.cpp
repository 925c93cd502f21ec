#include "supervisor/pddl/search/pruning/value_order.h"

#include <utility>

namespace stepwright::pddl {
namespace {

// The table of a variable is its values squared.
constexpr int kMostValues = 128;

}  // namespace

ValueOrder::ValueOrder(const StateSpace& space) : task_(space.task()), domains_(space.domains()) {}

void ValueOrder::enter_all() {
  tables_.resize(domains_.size());
  for (std::size_t v = 0; v < tables_.size(); ++v) {
    const bool derived = domains_[v].first + domains_[v].count > task_.first_derived;
    const auto values = static_cast<std::size_t>(domains_[v].count) + 1;
    if (!derived && domains_[v].count < kMostValues) tables_[v].follows.assign(values * values, false);
  }
  for (const GroundOperator& op : task_.operators) enter(op);
}

// The value that the literal stands for: of a group, only that one of its facts holds is one value.
std::optional<VariableValue> ValueOrder::need(int literal) const {
  const int variable = domains_.variable_of(literal / 2);
  const DomainVariable& domain = domains_[static_cast<std::size_t>(variable)];
  if (literal % 2 == 0) return VariableValue{variable, literal / 2 - domain.first};
  if (domain.count == 1) return VariableValue{variable, 1};
  return std::nullopt;
}

void ValueOrder::add_edge(int variable, int from, int to) {
  auto& follows = tables_[static_cast<std::size_t>(variable)].follows;
  const auto values = static_cast<std::size_t>(domains_[static_cast<std::size_t>(variable)].count) + 1;
  if (!follows.empty())
    follows[static_cast<std::size_t>(from) * values + static_cast<std::size_t>(to)] = true;
}

// Where the precondition says nothing of the variable, an added fact may follow every value.
void ValueOrder::enter(const GroundOperator& op) {
  const auto before = [&](int variable) {
    for (const int literal : op.precondition.literals) {
      const std::optional<VariableValue> asked = need(literal);
      if (asked && asked->variable == variable) return asked->value;
    }
    return -1;
  };
  for (const GroundEffect& effect : op.effects) {
    for (const int fact : effect.adds) {
      const int variable = domains_.variable_of(fact), from = before(variable);
      const DomainVariable& domain = domains_[static_cast<std::size_t>(variable)];
      for (int value = 0; value <= domain.count; ++value) {
        if (from < 0 || from == value) add_edge(variable, value, fact - domain.first);
      }
    }
    for (const int fact : effect.deletes) {
      const int variable = domains_.variable_of(fact);
      const DomainVariable& domain = domains_[static_cast<std::size_t>(variable)];
      add_edge(variable, fact - domain.first, domain.count);
    }
  }
}

void ValueOrder::complete(int variable) {
  Table& table = tables_[static_cast<std::size_t>(variable)];
  auto& follows = table.follows;
  if (std::exchange(table.complete, true) || follows.empty()) return;
  const auto values = static_cast<std::size_t>(domains_[static_cast<std::size_t>(variable)].count) + 1;
  for (std::size_t v = 0; v < values; ++v) follows[v * values + v] = true;
  for (std::size_t by = 0; by < values; ++by) {
    for (std::size_t from = 0; from < values; ++from) {
      if (!follows[from * values + by]) continue;
      for (std::size_t to = 0; to < values; ++to) {
        if (follows[by * values + to]) follows[from * values + to] = true;
      }
    }
  }
}

bool ValueOrder::can_follow(int variable, int now, int value) const {
  const auto& follows = tables_[static_cast<std::size_t>(variable)].follows;
  const auto values = static_cast<std::size_t>(domains_[static_cast<std::size_t>(variable)].count) + 1;
  return follows.empty() || follows[static_cast<std::size_t>(now) * values + static_cast<std::size_t>(value)];
}

int ValueOrder::fact_of(const VariableValue& value) const {
  const DomainVariable& domain = domains_[static_cast<std::size_t>(value.variable)];
  return value.value < domain.count ? domain.first + value.value : -1;
}

bool ValueOrder::passes(const VariableValue& asked) {
  complete(asked.variable);
  const int values = domains_[static_cast<std::size_t>(asked.variable)].count + 1;
  for (int next = 0; next < values; ++next) {
    if (can_follow(asked.variable, asked.value, next) && !can_follow(asked.variable, next, asked.value))
      return true;
  }
  return false;
}

std::vector<VariableValue> ValueOrder::passing_needs(const GroundOperator& op) {
  if (tables_.empty()) enter_all();
  std::vector<VariableValue> list;
  for (const int literal : op.precondition.literals) {
    const std::optional<VariableValue> asked = need(literal);
    if (asked && passes(*asked)) list.push_back(*asked);
  }
  return list;
}

}  // namespace stepwright::pddl
