#pragma once

// Declarations of the syntax tree: types, variables, POUs, charts, configurations.

#include <optional>
#include <string_view>
#include <vector>

#include "ladder/syntax/statement.h"

namespace stepwright::syntax {

struct TypeSpec;
using TypeSpecPtr = std::unique_ptr<TypeSpec>;

enum class Section : std::uint8_t { Local, Temp, Input, Output, InOut, External, Global };

// One line of a VAR section; several names share it.
struct VariableDeclaration {
  std::vector<Name> names;
  Section section = Section::Local;
  bool constant = false;
  bool retain = false;
  std::optional<DirectAddress> address;
  source::Position address_where;
  TypeSpecPtr type;
  ExpressionPtr initial;  // may be null
};

enum class TypeKind : std::uint8_t { Error, Named, Array, Struct, Enumeration };

struct ArrayRange {
  ExpressionPtr low;
  ExpressionPtr high;
};

struct Enumerator {
  Name name;
  ExpressionPtr value;  // null = the one before + 1
};

struct TypeSpec {
  TypeKind kind = TypeKind::Error;
  source::Position where;
  Name name;                                // Named
  std::vector<ArrayRange> ranges;           // Array
  TypeSpecPtr element;                      // Array
  std::vector<VariableDeclaration> fields;  // Struct
  std::vector<Enumerator> enumerators;      // Enumeration
};

struct TypeDeclaration {
  Name name;
  TypeSpecPtr type;
  ExpressionPtr initial;  // default of the type; may be null
};

// A piece of a source, copied into a generated text with a mark of where it came from.
struct TextSlice {
  std::string_view text;
  source::Position where;
};

// Textual SFC (2.6). Expressions and bodies keep their text too: charts carry ST as text.
struct ActionUse {
  Name action;
  std::string_view qualifier;  // empty = N
  source::Position qualifier_where;
  TextSlice duration;                 // empty if none
  std::vector<TextSlice> indicators;  // variables
};

struct StepDeclaration {
  Name name;
  bool initial = false;
  std::vector<ActionUse> actions;
};

struct TransitionDeclaration {
  std::optional<Name> name;
  std::optional<std::uint64_t> priority;
  std::vector<Name> sources;
  std::vector<Name> targets;
  TextSlice condition;
  source::Position where;
};

struct ActionDeclaration {
  Name name;
  TextSlice body;
};

struct Chart {
  std::vector<StepDeclaration> steps;
  std::vector<TransitionDeclaration> transitions;
  std::vector<ActionDeclaration> actions;
  bool final_scan = false;  // {sfc_final_scan}
};

enum class PouKind : std::uint8_t { Program, FunctionBlock, Function };

struct PouDeclaration {
  Name name;
  PouKind kind = PouKind::Program;
  TypeSpecPtr result;  // functions; null otherwise
  std::vector<VariableDeclaration> variables;
  Statements body;
  std::optional<Chart> chart;  // instead of `body`
  source::Position end;        // of END_...: where the body returns
};

struct TaskDeclaration {
  Name name;
  ExpressionPtr interval;  // null = none given
  ExpressionPtr priority;
};

struct ProgramDeclaration {
  Name name;
  std::optional<Name> task;
  Name type;
};

struct Configuration {
  Name name;
  std::vector<VariableDeclaration> globals;  // its own and those of its resources
  std::vector<TaskDeclaration> tasks;
  std::vector<ProgramDeclaration> programs;
};

// All declarations of a compilation, in the order of the sources.
struct Unit {
  std::vector<TypeDeclaration> types;
  std::vector<PouDeclaration> pous;
  std::vector<VariableDeclaration> globals;  // VAR_GLOBAL outside of a configuration
  std::vector<Configuration> configurations;
};

}  // namespace stepwright::syntax
