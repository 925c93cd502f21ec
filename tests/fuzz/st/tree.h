#pragma once

// A program as a typed tree: made once by the generator, written out as ST (st_writer.h) and as C
// (c_writer.h). Every implicit conversion is a node of its own (Widen), which ST does not show. What C has no
// translation for is text (extras/).

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "tests/fuzz/st/scalar.h"

namespace stepwright::st_fuzz {

struct Pou;
struct Type;
struct Expression;
using ExpressionPtr = std::unique_ptr<Expression>;

struct Field {
  std::string name;
  const Type* type;
};

struct Bounds {
  std::int64_t low;
  std::int64_t high;
  std::int64_t count() const { return high - low + 1; }
};

enum class TypeKind : std::uint8_t { Elementary, Subrange, Enumeration, Array, Struct, Block };

struct Type {
  TypeKind kind = TypeKind::Elementary;
  std::string name = {};                      // in C; in ST of all but arrays
  Scalar scalar = Scalar::Bool;               // all but arrays, structures, blocks
  std::int64_t low = 0;                       // Subrange
  std::int64_t high = 0;                      // Subrange
  std::vector<std::string> enumerators = {};  // Enumeration; numbered from `low` on
  std::vector<Bounds> bounds = {};            // Array
  const Type* element = nullptr;              // Array
  std::vector<Field> fields = {};             // Struct
  const Pou* block = nullptr;                 // Block

  bool is_scalar() const { return kind <= TypeKind::Enumeration; }
};

enum class Section : std::uint8_t { Input, Output, InOut, Local, Temp, Result };

struct Variable {
  std::string name;
  const Type* type = nullptr;
  Section section = Section::Local;
  std::string location = {};  // "%QX0.3"; empty: none
  std::uint64_t initial = 0;  // scalars: bits
  bool writable = true;       // false: the variable of a loop
};

// The way from a variable to a part of it: a field or an element at each step.
struct Step {
  std::string field = {};
  const Type* array = nullptr;
  std::vector<ExpressionPtr> indexes = {};
};

struct Place {
  const Variable* variable = nullptr;
  std::vector<Step> steps = {};
  const Type* type = nullptr;
  int bit = -1;  // a bit of a bit string: a BOOL
};

enum class Operation : std::uint8_t {
  Literal,
  Load,
  Widen,
  Convert,
  Truncate,
  Call,
  Negate,
  Not,
  Add,
  Subtract,
  Multiply,
  Divide,
  Modulo,
  Power,
  Equal,
  NotEqual,
  Less,
  Greater,
  LessEqual,
  GreaterEqual,
  And,
  Or,
  Xor,
  AndThen,
  OrElse,
  Shl,
  Shr,
  Rol,
  Ror,
  Abs,
  Sqrt,
  Exp,
  Ln,
  Sin,
  Atan,
  Min,
  Max,
  Limit,
  Sel,
  Mux,
};
inline constexpr unsigned kOperations = static_cast<unsigned>(Operation::Mux) + 1;

// Operands in the order of ST's parameters: LIMIT MN IN MX, SEL G IN0 IN1, MUX K IN0 ...
struct Expression {
  Operation operation = Operation::Literal;
  const Type* type = nullptr;
  std::uint64_t bits = 0;  // Literal
  Place place = {};        // Load
  std::vector<ExpressionPtr> operands = {};
  const Pou* callee = nullptr;  // Call
  bool constant = false;        // known to the compiler
  bool anonymous = false;       // Convert: TO_INT instead of DINT_TO_INT
};

enum class StatementKind : std::uint8_t {
  Assign,
  Copy,
  CallBlock,
  CallFunction,
  If,
  Case,
  For,
  While,
  Repeat,
  Exit,
  Continue,
  Return,
  Text,
};
inline constexpr unsigned kStatementKinds = static_cast<unsigned>(StatementKind::Text) + 1;

struct Statement;
using Statements = std::vector<Statement>;

struct Argument {
  const Variable* parameter;
  ExpressionPtr value;  // inputs
  Place place;          // outputs and VAR_IN_OUT
};

struct CaseLabel {
  std::uint64_t low;
  std::uint64_t high;
};

struct Branch {
  ExpressionPtr condition = nullptr;   // If; null: ELSE
  std::vector<CaseLabel> labels = {};  // Case; empty: ELSE
  Statements body = {};
};

struct Statement {
  StatementKind kind;
  int id;                             // unique in the program
  Place target = {};                  // Assign, Copy, CallBlock (the instance), CallFunction
  Place source = {};                  // Copy
  const Pou* callee = nullptr;        // CallFunction
  ExpressionPtr value = nullptr;      // Assign, Case, For (start), While, Repeat
  ExpressionPtr limit = nullptr;      // For
  ExpressionPtr step = nullptr;       // For; null: 1
  const Variable* counter = nullptr;  // For; While and Repeat: bounds the turns
  int turns = 0;                      // While, Repeat
  std::vector<Argument> arguments = {};
  std::vector<Branch> branches = {};
  Statements body = {};
  std::string text = {};            // Text: ST as it stands there
  const char* construct = nullptr;  // Text: what it shows (extras/extra.h)
};

struct Action {
  std::string name;
  Statements body;
};

enum class PouKind : std::uint8_t { Function, Block, Program };

struct Pou {
  PouKind kind = PouKind::Program;
  std::string name = {};
  const Type* result = nullptr;  // Function
  const Type* type = nullptr;    // Block
  std::deque<Variable> variables = {};
  Statements body = {};
  std::string declarations = {};     // as text, behind those of `variables`
  std::string chart = {};            // steps and transitions as text, in place of a body
  std::vector<Action> actions = {};  // of the chart
};

struct Program {
  std::uint64_t seed = 0;
  std::deque<Type> types = {};               // each behind the ones that it needs
  std::deque<Pou> pous = {};                 // each behind the ones that it calls; the last is PROGRAM main
  std::vector<const Variable*> inputs = {};  // of main: set before each scan
  int statements = 0;
  std::string before = {};         // POUs and types as text, in front of all
  std::string configuration = {};  // as text
  bool ladder = false;             // with the function block of extras/ladder.h, of the same seed

  const Pou& main() const { return pous.back(); }
};

}  // namespace stepwright::st_fuzz
