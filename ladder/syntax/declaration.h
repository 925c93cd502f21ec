#pragma once

// Declarations of the syntax tree: types, variables, POUs, charts, configurations.

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ladder/syntax/statement.h"

namespace stepwright::syntax {

struct TypeSpec;
using TypeSpecPtr = std::unique_ptr<TypeSpec>;

enum class Edge : std::uint8_t { None, Rising, Falling };

enum class Section : std::uint8_t { Local, Temp, Input, Output, InOut, External, Global };

// One line of a VAR section; several names share it.
struct VariableDeclaration {
  std::vector<Name> names;
  Section section = Section::Local;
  bool constant = false;
  bool retain = false;
  bool non_retain = false;
  Edge edge = Edge::None;  // R_EDGE, F_EDGE of an input
  std::optional<DirectAddress> address;
  std::optional<Area> open_address;         // AT %I*: VAR_CONFIG gives the address
  std::optional<RelativeAddress> relative;  // of a member of a structure: AT %B0
  source::Position address_where;
  TypeSpecPtr type;
  ExpressionPtr initial;   // may be null
  bool generated = false;  // by the lowering of a diagram
};

// Deduced: that of the first value that is assigned, in the order of the text; no source can write it, the
// wires of diagrams have it.
enum class TypeKind : std::uint8_t {
  Error,
  Named,
  Array,
  Struct,
  Enumeration,
  Subrange,
  Text,
  Reference,
  Deduced,
};

// Both null: '*', the bounds are those of the argument.
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
  Name name;                                // Named; Subrange, Enumeration: the base; Text: (W)STRING
  std::vector<ArrayRange> ranges;           // Array; Subrange: one
  TypeSpecPtr element;                      // Array; Reference: what it leads to
  ExpressionPtr length;                     // Text: characters
  std::vector<VariableDeclaration> fields;  // Struct
  bool overlap = false;                     // Struct: OVERLAP, its members may share memory
  std::vector<Enumerator> enumerators;      // Enumeration
};

// Where names of a declaration are looked for (namespaces.h): of a POU, a namespace or a file. Unit::scopes
// owns them.
struct NameScope {
  const NameScope* outer = nullptr;     // around this one
  std::optional<source::NameId> space;  // full name, of a namespace
  std::vector<Name> used;               // USING
};

struct TypeDeclaration {
  Name name;
  const NameScope* scope = nullptr;
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

// The language that the statements of a body were written in.
enum class BodyOrigin : std::uint8_t { Text, Ladder, Chart };

struct PouDeclaration {
  Name name;
  const NameScope* scope = nullptr;
  PouKind kind = PouKind::Program;
  TypeSpecPtr result;  // functions; null otherwise
  std::vector<VariableDeclaration> variables;
  Statements body;
  BodyOrigin origin = BodyOrigin::Text;
  std::optional<Chart> chart;  // instead of `body`
  source::Position end;        // of END_...: where the body returns
};

// TEST 'name' ... END_TEST (ladder/doc/testing.md).
struct TestDeclaration {
  std::string name;
  PouDeclaration body;  // a program under a name that no source can write; where it stands is the quoted name
};

struct TaskDeclaration {
  Name name;
  ExpressionPtr single;    // null = none given
  ExpressionPtr interval;  // null = none given
  ExpressionPtr priority;
};

// PROGRAM p WITH t : type (block WITH task)
struct BlockTask {
  Name block;
  Name task;
};

struct ProgramDeclaration {
  Name name;
  std::optional<Name> task;
  Name type;
  bool retain = false;
  bool non_retain = false;
  std::vector<Argument> connections;  // in := global, out => global
  std::vector<BlockTask> block_tasks;
  bool broken = false;  // reported by the parser: only the name is there
};

// Tasks and programs that stand in no RESOURCE belong to one without a name.
struct Resource {
  Name name;
  std::vector<VariableDeclaration> globals;
  std::vector<TaskDeclaration> tasks;
  std::vector<ProgramDeclaration> programs;
};

// A line of VAR_CONFIG: the address or the first value of a variable inside of an instance.
struct ConfiguredVariable {
  std::vector<Name> path;  // [resource,] program instance, block instances, variable
  std::optional<DirectAddress> address;
  source::Position address_where;
  TypeSpecPtr type;
  ExpressionPtr initial;  // may be null
};

struct Configuration {
  Name name;
  const NameScope* scope = nullptr;
  std::vector<VariableDeclaration> globals;
  std::vector<Resource> resources;
  std::vector<ConfiguredVariable> configured;
};

// A namespace, or a part of one that is INTERNAL, by its full name.
struct NamespacePart {
  Name name;
  std::optional<source::NameId> internal_to;  // the namespace that alone can use it
  bool is_namespace = true;
};

// Where names of the globals before `end` are looked for, from those of the scope before on.
struct GlobalScope {
  std::size_t end = 0;
  const NameScope* scope = nullptr;
};

// All declarations of a compilation, in the order of the sources.
struct Unit {
  std::vector<TypeDeclaration> types;
  std::vector<PouDeclaration> pous;
  std::vector<VariableDeclaration> globals;  // VAR_GLOBAL outside of a configuration
  std::vector<GlobalScope> global_scopes;    // in the order of `globals`
  std::vector<Configuration> configurations;
  std::vector<TestDeclaration> tests;
  std::vector<PouDeclaration> mocks;  // MOCK FUNCTION name ... END_MOCK: for the tests of its file
  std::vector<NamespacePart> namespaces;
  std::deque<NameScope> scopes;
  std::deque<std::string> spellings;  // texts of full names
};

}  // namespace stepwright::syntax
