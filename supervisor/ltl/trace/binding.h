#pragma once

// Meaning of a proposition in a trace: a BOOL column, or a comparison of a column with a value.
//
//   read_binding("full=MAIN.level >= 20")   read_binding("idle=MAIN.mode = Idle")
//   read_binding("go=!MAIN.stop")
//
// Thread rule: pure functions.

#include <string>
#include <string_view>

#include "runtime/ground/result/result.h"

namespace stepwright::ltl {

enum class Relation : std::uint8_t {
  Holds,
  HoldsNot,
  Less,
  LessEqual,
  Equal,
  Unequal,
  GreaterEqual,
  Greater
};

struct Binding {
  std::string proposition;
  std::string column;
  Relation relation = Relation::Holds;
  std::string value;  // of a comparison: a number, or for = and <> any text
};

// NAME=COLUMN, NAME=!COLUMN or NAME=COLUMN OP VALUE with < <= = <> >= >. L0043: something else.
[[nodiscard]] result::Result<Binding> read_binding(std::string_view text);

}  // namespace stepwright::ltl
