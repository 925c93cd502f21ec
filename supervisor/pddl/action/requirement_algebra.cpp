#include "supervisor/pddl/action/requirement_algebra.h"

#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "supervisor/pddl/definition/numeric.h"
#include "supervisor/pddl/definition/state.h"
#include "supervisor/pddl/definition/text.h"

namespace stepwright::pddl {
namespace {

// Sum of coefficient x fluent, and a constant.
struct Linear {
  std::map<std::string, double> terms;
  double constant = 0.0;
};

void add(Linear& sum, const Linear& term, double factor) {
  sum.constant = snap(sum.constant + factor * term.constant);
  for (const auto& [fluent, coefficient] : term.terms) {
    double& total = sum.terms[fluent];
    total = snap(total + factor * coefficient);
    if (total == 0.0) sum.terms.erase(fluent);
  }
}

std::optional<Linear> linear(const NumericNode& node) {
  if (node.kind == NumericKind::Constant) return Linear{{}, node.constant};
  if (node.kind == NumericKind::Fluent) return Linear{{{node.fluent, 1.0}}, 0.0};
  auto left = linear(node.operands.front());
  if (!left) return std::nullopt;
  Linear result;
  if (node.kind == NumericKind::Negate) {
    add(result, *left, -1.0);
    return result;
  }
  const auto right = linear(node.operands.back());
  if (!right) return std::nullopt;
  switch (node.kind) {
    case NumericKind::Add:
      add(*left, *right, 1.0);
      return left;
    case NumericKind::Subtract:
      add(*left, *right, -1.0);
      return left;
    case NumericKind::Multiply:
      if (!left->terms.empty() && !right->terms.empty()) return std::nullopt;
      add(result, left->terms.empty() ? *right : *left,
          left->terms.empty() ? left->constant : right->constant);
      return result;
    case NumericKind::Divide:
      if (!right->terms.empty() || right->constant == 0.0) return std::nullopt;
      add(result, *left, 1.0 / right->constant);
      return result;
    default:
      return std::nullopt;
  }
}

std::string print(const NumericNode& node) {
  if (node.kind == NumericKind::Constant) return number_text(node.constant);
  if (node.kind == NumericKind::Fluent) return node.fluent;
  if (node.kind == NumericKind::Negate) return "(- 0 " + print(node.operands.front()) + ")";
  return std::string("(") + symbol_of(node.kind) + " " + print(node.operands.front()) + " " +
         print(node.operands.back()) + ")";
}

NumericNode sum_of(const Linear& form) {
  std::optional<NumericNode> sum;
  for (const auto& [fluent, coefficient] : form.terms) {
    NumericNode term = fluent_node(fluent);
    if (coefficient != 1.0) {
      term = operation(NumericKind::Multiply, constant_node(coefficient), std::move(term));
    }
    sum = sum ? operation(NumericKind::Add, std::move(*sum), std::move(term)) : std::move(term);
  }
  return sum.value_or(constant_node(0.0));
}

// Joins the parts of `kind`, whose own empty form is `neutral` and that of the other kind decides.
Requirement joined(RequirementKind kind, std::vector<Requirement> parts) {
  const RequirementKind other = kind == RequirementKind::All ? RequirementKind::Any : RequirementKind::All;
  Requirement result;
  result.kind = kind;
  std::set<std::string> seen;
  const auto append = [&](Requirement part) {
    if (seen.insert(part.text).second) result.parts.push_back(std::move(part));
  };
  for (Requirement& part : parts) {
    if (part.kind == other && part.parts.empty()) return part;
    if (part.kind != kind) {
      append(std::move(part));
      continue;
    }
    for (Requirement& nested : part.parts) append(std::move(nested));
  }
  if (result.parts.size() == 1) return std::move(result.parts.front());
  result.text = kind == RequirementKind::All ? "(and" : "(or";
  for (const Requirement& part : result.parts) result.text += " " + part.text;
  result.text += ")";
  return result;
}

}  // namespace

Requirement all_of(std::vector<Requirement> parts) {
  return joined(RequirementKind::All, std::move(parts));
}

Requirement any_of(std::vector<Requirement> parts) {
  return joined(RequirementKind::Any, std::move(parts));
}

Requirement fact_is(const std::string& fact, bool positive) {
  Requirement requirement;
  requirement.fact = fact;
  requirement.positive = positive;
  requirement.text = positive ? fact : "(not " + fact + ")";
  return requirement;
}

Requirement comparison(NumericNode left, Relation relation, NumericNode right) {
  const auto a = linear(left);
  const auto b = linear(right);
  if (a && b) {
    Linear difference = *a;
    add(difference, *b, -1.0);
    if (difference.terms.empty()) {
      return compare(relation, difference.constant) ? all_of({}) : any_of({});
    }
    left = sum_of(difference);
    right = constant_node(-difference.constant + 0.0);
  }
  Requirement requirement;
  requirement.kind = RequirementKind::Comparison;
  requirement.relation = relation;
  requirement.text = std::string("(") + symbol_of(relation) + " " + print(left) + " " + print(right) + ")";
  requirement.left = std::move(left);
  requirement.right = std::move(right);
  return requirement;
}

Requirement negation(const Requirement& requirement) {
  switch (requirement.kind) {
    case RequirementKind::Fact:
      return fact_is(requirement.fact, !requirement.positive);
    case RequirementKind::Comparison:
      if (requirement.relation == Relation::Equal) {
        return any_of({comparison(requirement.left, Relation::Less, requirement.right),
                       comparison(requirement.left, Relation::Greater, requirement.right)});
      }
      return comparison(requirement.left, opposite(requirement.relation), requirement.right);
    case RequirementKind::Any:
    case RequirementKind::All:
      break;
  }
  std::vector<Requirement> parts;
  for (const Requirement& part : requirement.parts) parts.push_back(negation(part));
  return requirement.kind == RequirementKind::Any ? all_of(std::move(parts)) : any_of(std::move(parts));
}

bool is_true(const Requirement& requirement) {
  return requirement.kind == RequirementKind::All && requirement.parts.empty();
}

bool is_false(const Requirement& requirement) {
  return requirement.kind == RequirementKind::Any && requirement.parts.empty();
}

Requirement normalized(const Requirement& requirement) {
  if (requirement.kind == RequirementKind::Fact) return fact_is(requirement.fact, requirement.positive);
  if (requirement.kind == RequirementKind::Comparison) {
    return comparison(requirement.left, requirement.relation, requirement.right);
  }
  std::vector<Requirement> parts;
  for (const Requirement& part : requirement.parts) parts.push_back(normalized(part));
  return requirement.kind == RequirementKind::Any ? any_of(std::move(parts)) : all_of(std::move(parts));
}

NumericNode constant_node(double value) {
  NumericNode node;
  node.constant = value;
  return node;
}

NumericNode fluent_node(const std::string& fluent) {
  NumericNode node;
  node.kind = NumericKind::Fluent;
  node.fluent = fluent;
  return node;
}

NumericNode operation(NumericKind kind, NumericNode left, NumericNode right) {
  NumericNode node;
  node.kind = kind;
  node.operands.push_back(std::move(left));
  node.operands.push_back(std::move(right));
  return node;
}

NumericNode substituted(const NumericNode& node, const std::map<std::string, NumericNode>& values) {
  if (node.kind == NumericKind::Fluent) {
    const auto found = values.find(node.fluent);
    return found == values.end() ? node : found->second;
  }
  NumericNode result = node;
  for (NumericNode& operand : result.operands) operand = substituted(operand, values);
  return result;
}

std::size_t size_of(const Requirement& requirement) {
  std::size_t size = 1;
  for (const Requirement& part : requirement.parts) size += size_of(part);
  return size;
}

}  // namespace stepwright::pddl
