#pragma once

// Writes parts of a task as texts, with facts and variables exchanged: two parts of the same meaning have the
// same text. The order within a list of conditions or effects does not matter.
//
// Thread rule: immutable; the exchange must outlive it.
//
//   ExchangeText exchanged(exchange), same(identity);
//   if (exchanged.text(task.goal) == same.text(task.goal)) ...   // the goal stays what it is

#include <string>
#include <vector>

#include "supervisor/pddl/ground_task/ground_task.h"

namespace stepwright::pddl {

// Replacement of every fact and variable, by number.
struct Exchange {
  std::vector<int> facts, variables;
};

class ExchangeText {
 public:
  explicit ExchangeText(const Exchange& exchange) : exchange_(exchange) {}

  std::string text(const GroundOperator& op) const;
  std::string text(const GroundAxiom& axiom) const;
  std::string text(const Condition& condition) const;
  std::string text(const GroundExpression& expression) const;

 private:
  std::string text(const GroundEffect& effect) const;
  int fact(int f) const { return exchange_.facts[static_cast<std::size_t>(f)]; }
  int variable(int v) const { return exchange_.variables[static_cast<std::size_t>(v)]; }

  const Exchange& exchange_;
};

}  // namespace stepwright::pddl
