#pragma once

// Expressions of the syntax tree: what was written, with places, without types.
//
// Text views point into the SourceSet of the compilation and live as long as it does.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ladder/source/name_table.h"
#include "ladder/source/source_set.h"
#include "ladder/syntax/direct_address.h"

namespace stepwright::syntax {

struct Expression;
using ExpressionPtr = std::unique_ptr<Expression>;

// An identifier where it stands.
struct Name {
  source::NameId id;
  std::string_view text;
  source::Position where;
};

enum class ExpressionKind : std::uint8_t {
  Error,         // reported by the parser; later stages stay silent about it
  Boolean,       // `integer` is 0 or 1
  Integer,       // `integer`
  Real,          // `real`
  Time,          // `time_ns`, as in the next three
  Date,          // since 1970-01-01
  TimeOfDay,     // since midnight
  DateAndTime,   // since 1970-01-01
  String,        // `characters`, each below 256
  WideString,    // `characters`
  Null,          // the reference to nothing
  Variable,      // `name`
  EnumValue,     // `prefix`#`name`
  Direct,        // `address`
  Field,         // operands[0] . `name`
  Index,         // operands[0] [ operands[1], ... ]
  Dereference,   // operands[0] ^
  Part,          // operands[0] . %X3: the `integer`th group of `part_bits` bits
  Unary,         // `op` operands[0]
  Binary,        // operands[0] `op` operands[1] `op` ...: a chain of one operator, evaluated from the left
  Call,          // `name` ( arguments ), or operands[0] ( arguments )
  ArrayValues,   // [ operands ]: initial values of an array
  Repeat,        // operands[0] ( operands[1] ): in ArrayValues only; no operands[1] = default value
  StructValues,  // ( arguments ): initial values of a structure or a function block
};

enum class Operator : std::uint8_t {
  Or,
  Xor,
  And,
  OrElse,
  AndThen,
  Equal,
  NotEqual,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  Add,
  Subtract,
  Multiply,
  Divide,
  Modulo,
  Power,
  Negate,
  Plus,
  Not,
};

// One argument of a call: "x", "IN := x", "Q => y", "NOT Q => y".
struct Argument {
  std::optional<Name> formal;
  bool is_output = false;
  bool negated = false;  // outputs only
  ExpressionPtr value;
  std::string_view text;  // of the value, as it was written; in TESTs only
};

struct Expression {
  ExpressionKind kind = ExpressionKind::Error;
  Operator op = Operator::Or;
  bool based = false;          // Integer: written with a base, may fill all bits of a bit string
  std::uint8_t part_bits = 1;  // Part: 1, 8, 16, 32 or 64
  std::uint16_t depth = 1;     // of the tree below, bounded by the parser
  source::Position where;
  std::uint64_t integer = 0;
  double real = 0;
  std::int64_t time_ns = 0;
  std::u16string characters;
  Name name;
  std::optional<Name> prefix;  // literals: "INT" of INT#5
  DirectAddress address;
  std::vector<ExpressionPtr> operands;
  std::vector<Argument> arguments;
  // Call: EN := ... and ENO => ..., which every call may have (6.6.1.4); not among `arguments`.
  std::unique_ptr<Argument> enable;
  std::unique_ptr<Argument> enabled;
};

// "AND", ">="
const char* to_string(Operator op);

}  // namespace stepwright::syntax
