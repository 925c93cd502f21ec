#pragma once

// A boolean condition of an SFC's transition or a ladder's rung, as a tree of contacts and comparisons. All
// languages and drawings use this form.
//
//   Condition c = all({contact("fc1"), compare("S1", CompareOp::GreaterEqual, "3784")});
//   to_st(c)  ->  "fc1 AND (S1 >= 3784)"

#include <cstdint>
#include <string>
#include <vector>

namespace stepwright::graphic {

enum class CompareOp : std::uint8_t { Equal, NotEqual, Less, LessEqual, Greater, GreaterEqual };

enum class ConditionKind : std::uint8_t {
  True,        // always: a closed wire
  Contact,     // `name`, negated or not, or an edge of it
  Comparison,  // `name` op `operand`
  All,         // children in series
  Any,         // children in parallel
  Expression,  // any other boolean ST expression, kept as its source text in `name`
};

enum class Edge : std::uint8_t { None, Rising, Falling };

struct Condition {
  ConditionKind kind = ConditionKind::True;
  std::string name;                 // Contact: variable; Comparison: left operand; Expression: ST text
  bool negated = false;             // Contact and Expression only
  Edge edge = Edge::None;           // Contact only
  CompareOp op = CompareOp::Equal;  // Comparison only
  std::string operand;              // Comparison only: right operand, a variable or a literal
  std::vector<Condition> children;  // All, Any

  friend bool operator==(const Condition&, const Condition&) = default;
};

Condition always();
Condition contact(std::string name, bool negated = false);
Condition compare(std::string left, CompareOp op, std::string right);
// Nested conditions of the same kind are flattened; a single child stands for itself; no child is True.
Condition all(std::vector<Condition> children);
Condition any(std::vector<Condition> children);

// The negation of a condition. Edges stay contacts: ST text has no form for them.
Condition negation(const Condition& condition);
// True if a contact in it senses an edge.
bool senses_edge(const Condition& condition);

// The condition as an ST expression, fully parenthesised where precedence could surprise a reader.
std::string to_st(const Condition& condition);
// "=", "<>", "<", "<=", ">", ">="
const char* to_st(CompareOp op);

}  // namespace stepwright::graphic
