#include "ladder/graphic/condition.h"

#include <algorithm>
#include <utility>

namespace stepwright::graphic {
namespace {

// Children of the same kind move up into `into`; the closed wires of a series vanish.
void flatten(ConditionKind kind, std::vector<Condition>& from, std::vector<Condition>& into) {
  for (Condition& child : from) {
    if (child.kind == kind) {
      flatten(kind, child.children, into);
    } else if (kind != ConditionKind::All || child.kind != ConditionKind::True) {
      into.push_back(std::move(child));
    }
  }
}

Condition combine(ConditionKind kind, std::vector<Condition> children) {
  Condition result;
  std::vector<Condition> flat;
  flatten(kind, children, flat);
  if (flat.empty()) return result;
  if (flat.size() == 1) return std::move(flat.front());
  result.kind = kind;
  result.children = std::move(flat);
  return result;
}

std::string contact_st(const Condition& condition) {
  // An edge has no operator in ST; R_EDGE and F_EDGE are the keywords the standard has for it.
  std::string text = condition.name;
  if (condition.edge == Edge::Rising) text = "R_EDGE(" + text + ")";
  if (condition.edge == Edge::Falling) text = "F_EDGE(" + text + ")";
  return condition.negated ? "NOT " + text : text;
}

std::string joined(const Condition& condition, const char* separator) {
  std::string text;
  for (const Condition& child : condition.children) {
    if (!text.empty()) text += separator;
    const bool group = child.kind == ConditionKind::All || child.kind == ConditionKind::Any;
    text += group ? "(" + to_st(child) + ")" : to_st(child);
  }
  return text.empty() ? "TRUE" : text;
}

}  // namespace

Condition always() {
  return {};
}

Condition contact(std::string name, bool negated) {
  Condition result;
  result.kind = ConditionKind::Contact;
  result.name = std::move(name);
  result.negated = negated;
  return result;
}

Condition compare(std::string left, CompareOp op, std::string right) {
  Condition result;
  result.kind = ConditionKind::Comparison;
  result.name = std::move(left);
  result.op = op;
  result.operand = std::move(right);
  return result;
}

Condition all(std::vector<Condition> children) {
  return combine(ConditionKind::All, std::move(children));
}

Condition any(std::vector<Condition> children) {
  for (const Condition& child : children) {
    if (child.kind == ConditionKind::True) return always();
  }
  return combine(ConditionKind::Any, std::move(children));
}

Condition negation(const Condition& condition) {
  Condition result = condition;
  const bool series = condition.kind == ConditionKind::All;
  if (condition.kind == ConditionKind::Contact || condition.kind == ConditionKind::Expression) {
    result.negated = !condition.negated;
  } else if (senses_edge(condition)) {
    result.kind = series ? ConditionKind::Any : ConditionKind::All;
    for (Condition& child : result.children) child = negation(child);
  } else {
    result = {};
    result.kind = ConditionKind::Expression;
    result.name = to_st(condition);
    result.negated = true;
  }
  return result;
}

bool senses_edge(const Condition& condition) {
  return condition.edge != Edge::None ||
         std::any_of(condition.children.begin(), condition.children.end(), senses_edge);
}

std::string to_st(const Condition& condition) {
  switch (condition.kind) {
    case ConditionKind::True:
      return "TRUE";
    case ConditionKind::Contact:
      return contact_st(condition);
    case ConditionKind::Comparison:
      return "(" + condition.name + " " + to_st(condition.op) + " " + condition.operand + ")";
    case ConditionKind::All:
      return joined(condition, " AND ");
    case ConditionKind::Any:
      return joined(condition, " OR ");
    case ConditionKind::Expression:
      return condition.negated ? "NOT (" + condition.name + ")" : "(" + condition.name + ")";
  }
  return "TRUE";
}

const char* to_st(CompareOp op) {
  switch (op) {
    case CompareOp::Equal:
      return "=";
    case CompareOp::NotEqual:
      return "<>";
    case CompareOp::Less:
      return "<";
    case CompareOp::LessEqual:
      return "<=";
    case CompareOp::Greater:
      return ">";
    case CompareOp::GreaterEqual:
      return ">=";
  }
  return "=";
}

}  // namespace stepwright::graphic
