#pragma once

// The semantic model: everything that codegen needs to know of a compilation, resolved and checked.
//
// Memory: the areas %I, %Q, %M and Data, and frames. Data holds the globals, the instances of programs (with
// the function blocks in them, contiguous) and constants. A frame holds what a POU keeps in memory only while
// it runs: arrays and structures of functions, temporary variables, results and outputs of what it calls.
//
// A function's slots are its parameters: inputs (the address, if the value is in memory) and in-outs (the
// address) in the order of their declaration, each variable-length array followed by its bounds, then the
// addresses of the outputs, then the address of the result, if that is in memory. Then come its own
// variables.

#include <array>
#include <memory>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "ladder/semantics/model/statement.h"
#include "ladder/semantics/model/test_case.h"
#include "ladder/syntax/declaration.h"

namespace stepwright::semantics {

using syntax::PouKind;
using syntax::Section;

struct Variable {
  source::NameId name;
  std::string spelling;
  const Type* type = nullptr;  // null: its declaration is wrong, uses of it stay silent
  Section section = Section::Local;
  bool any_integer = false;  // ANY_INT of the library: takes and gives every integer type, itself a LINT
  bool deduced = false;      // its first assignment gives it its type and place
  bool constant = false;
  bool retain = false;
  bool non_retain = false;
  syntax::Edge edge = syntax::Edge::None;
  source::Position where;
  Place place;
  Place edge_place;           // of an input with R_EDGE or F_EDGE: what the body reads
  Place first;                // function input in memory, AT %I*: a constant with its first value
  std::vector<Place> bounds;  // variable-length array: lower and upper bound of each dimension, DINT
  std::optional<syntax::Area> open_address;  // AT %I*
  std::optional<syntax::DirectAddress> address;
  std::optional<Constant> value;    // of a constant that is folded where it is used
  std::optional<Constant> initial;  // of a scalar that is not in an instance

  // AT %I*: the instance holds the address. A bit has none: the instance holds its value.
  bool is_referred() const { return open_address && type != nullptr && !type->is_bool(); }
};

// Before the name of a function of the library: the function of the same inputs that tells whether that one
// has a value. A call with ENO connected asks it (error_guard.cpp).
inline constexpr std::string_view kConditionPrefix = "__CAN_";

struct Pou {
  source::NameId name;
  std::string spelling;
  PouKind kind = PouKind::Program;
  source::Position where;
  const syntax::PouDeclaration* declaration = nullptr;
  const Type* type = nullptr;    // its instances; null for a function
  bool has_result = false;       // of a function
  const Type* result = nullptr;  // null if there is none or its type is wrong
  std::uint32_t result_slot = 0;
  std::vector<Variable> variables;
  std::unordered_map<std::uint32_t, std::uint32_t> scope;  // NameId -> index into `variables`
  std::vector<bytecode::StackType> slots;                  // parameters first
  std::uint16_t parameter_count = 0;
  std::uint32_t frame_size = 0;  // bytes
  Block entry;                   // gives temporary variables their first values; runs before the body
  Block body;
  std::uint32_t label_count = 0;
  source::Position end;
  bool writes_outside = false;      // a global, an address, what a reference leads to; itself, not by calls
  std::vector<const Pou*> callees;  // functions called and blocks used, without repetition
  Test* test = nullptr;             // of the program that a TEST became
  bool watches = false;             // reads variables of program instances, and writes none but its own
  std::vector<std::uint32_t> watched;  // then: indexes of those instances, without repetition
  std::uint32_t outside_reads = 0;     // then: the assignments at its beginning whose values are read outside
  bool own_hidden = false;             // while such a value is analysed
  std::unordered_set<const Pou*> known_callees;  // the same, to be asked

  void note_callee(const Pou& callee) {
    if (known_callees.insert(&callee).second) callees.push_back(&callee);
  }
  const Variable* find(source::NameId id) const {
    const auto found = scope.find(id.value);
    return found == scope.end() ? nullptr : &variables[found->second];
  }
};

// RETAIN, NON_RETAIN: what a declaration says of the variables inside that say nothing themselves.
enum class Retention : std::uint8_t { Unsaid, Kept, Lost };

struct ProgramInstance {
  std::string name;
  const Pou* program = nullptr;
  std::uint32_t offset = 0;  // in Data
  Retention retention = Retention::Unsaid;
};

// A program that a task runs, or one that the analysis made to run it with its connections.
struct TaskCall {
  std::string name;
  const Pou* pou = nullptr;
  std::uint32_t offset = 0;  // in Data
};

// SINGLE: the BOOL whose rising edge runs a task.
struct Trigger {
  std::string name;
  Place place;  // direct
};

struct Task {
  std::string name;
  std::uint32_t interval_us =
      10'000;  // 0: runs by its trigger only; without one, again as soon as it has ended
  std::uint32_t priority = 0;
  std::optional<Trigger> trigger;
  std::vector<TaskCall> calls;
};

// A hierarchical address that the program uses: a place behind the flat addresses of its area (6.5.5.2 leaves
// the mapping open). Places in it have offsets from kHierarchicalPlace + its index * kHierarchicalStride on.
struct HierarchicalPlace {
  syntax::HierarchicalAddress address;
  source::NameId text;
  source::Position where;
  std::vector<std::byte> first;  // as large as what is declared there
  std::uint32_t start = 0;       // in the area
};
inline constexpr std::uint32_t kHierarchicalPlace = 0x4000'0000;
inline constexpr std::uint32_t kHierarchicalStride = 0x1'0000;

// A reference in an area that is known when the areas have their addresses.
struct FirstReference {
  Base base = Base::Data;
  std::uint32_t offset = 0;  // in the area
  Place target;
};

struct Model {
  TypeTable types;
  std::vector<std::unique_ptr<Pou>> pous;
  std::vector<Variable> globals;
  std::vector<ProgramInstance> instances;
  std::vector<Variable> configured;  // what VAR_CONFIG gives an address: `spelling` is its path
  std::vector<Task> tasks;
  // Initial bytes of %I, %Q, %M and Data (the order of Base).
  std::array<std::vector<std::byte>, 4> areas;

  // In the order of the sources: the calls of the last task, all of which have one piece of Data, as only one
  // test runs at a time and from a fresh image. The task's trigger never rises.
  std::vector<std::unique_ptr<Test>> tests;

  std::vector<HierarchicalPlace> hierarchical;
  std::vector<FirstReference> references;

  // Where the offset of a place lies in its area.
  std::uint32_t offset_in_area(std::uint32_t offset, Base base) const {
    if (base >= Base::Data || offset < kHierarchicalPlace) return offset;
    const std::uint32_t behind = offset - kHierarchicalPlace;
    return hierarchical[behind / kHierarchicalStride].start + behind % kHierarchicalStride;
  }

  std::vector<std::byte>& area(Base base) { return areas[static_cast<std::size_t>(base)]; }
  const std::vector<std::byte>& area(Base base) const { return areas[static_cast<std::size_t>(base)]; }
};

}  // namespace stepwright::semantics
