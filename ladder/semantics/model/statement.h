#pragma once

// Statements after analysis. See value.h.

#include <vector>

#include "ladder/semantics/model/value.h"

namespace stepwright::semantics {

enum class StatementKind : std::uint8_t {
  Assign,    // target := value; aggregates and strings are copied
  Evaluate,  // value, whose result is dropped
  Instance,  // copies `before`, runs the block at `target`, copies `after`
  If,        // branches with conditions; the last one without a condition is ELSE
  Case,      // value; branches with ranges; the last one without ranges is ELSE
  For,
  While,   // value, body
  Repeat,  // body, value
  Exit,
  Continue,
  Return,
  Jump,  // to `label`
  Label,
};

struct CaseRange {
  Constant low;
  Constant high;
};

struct Statement;
using Block = std::vector<Statement>;

struct Branch {
  ValuePtr condition;
  std::vector<CaseRange> ranges;
  Block body;
};

struct Statement {
  StatementKind kind = StatementKind::Return;
  source::Position where;
  bool passes_only = false;  // Instance: a task runs the block, the call copies only
  bool initial = false;      // Assign: the bytes are copied as they are, the target holds nothing yet
  Place target;              // Assign, For: what counts, Instance: the instance
  ValuePtr value;            // For: the first value
  ValuePtr limit;            // For; of the type of the target, as `step`
  ValuePtr step;
  std::vector<CopyBefore> before;
  std::vector<CopyAfter> after;
  std::vector<Branch> branches;
  Block body;
  std::uint32_t label = 0;
};

}  // namespace stepwright::semantics
