#pragma once

// Statements of the syntax tree (IEC 61131-3, 7.3.3), and the jumps and labels that ladder diagrams need.

#include <memory>
#include <vector>

#include "ladder/syntax/expression.h"

namespace stepwright::syntax {

struct Statement;
using StatementPtr = std::unique_ptr<Statement>;
using Statements = std::vector<StatementPtr>;

enum class StatementKind : std::uint8_t {
  Assign,   // target := value
  Attempt,  // target ?= value
  Call,     // value (an expression of kind Call)
  If,       // branches with conditions, otherwise
  Case,     // value; branches with labels, otherwise
  For,      // target := value TO limit BY step DO body
  While,    // value DO body
  Repeat,   // body UNTIL value
  Exit,
  Continue,
  Return,
  Jump,   // to `label`: lowered ladder diagrams only
  Label,  // `label`: lowered ladder diagrams only
};

// A label of CASE: one value, or a range.
struct CaseLabel {
  ExpressionPtr low;
  ExpressionPtr high;  // null for a single value
};

struct Branch {
  ExpressionPtr condition;        // If
  std::vector<CaseLabel> labels;  // Case
  Statements body;
};

struct Statement {
  StatementKind kind = StatementKind::Return;
  source::Position where;
  ExpressionPtr target;
  ExpressionPtr value;
  ExpressionPtr limit;
  ExpressionPtr step;  // null = 1
  std::vector<Branch> branches;
  bool has_else = false;
  Statements otherwise;
  Statements body;
  Name label;
};

}  // namespace stepwright::syntax
