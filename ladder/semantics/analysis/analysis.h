#pragma once

// Shared state of the analysis: the model in the making and the global names. One thread; it refers to model,
// names and sink, which outlive it.

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "ladder/semantics/model/model.h"
#include "ladder/source/codes.h"
#include "ladder/source/diagnostic_sink.h"
#include "ladder/source/dialect.h"

namespace stepwright::semantics::internal {

namespace code = source::code;
using source::NameId;
using source::Position;

struct EnumValue {
  const Type* type = nullptr;  // null: several enumerations have a value of this name
  std::int64_t value = 0;
};

// Target of REF(x) as a first value: a place of an area, or one within the instance that holds it.
struct FirstTarget {
  const Pou* owner = nullptr;  // whose instance; null: of an area
  Base base = Base::Data;      // of an area
  std::uint32_t offset = 0;
};

struct Analysis;
class ExpressionAnalyzer;
// What expressions need of calls, which are analysed above them: the value of one that stands in the POU;
// null after a report.
using ValueOfCall = ValuePtr(Analysis& analysis, ExpressionAnalyzer& expressions, Pou* pou,
                             const syntax::Expression& call);

struct Analysis {
  Model& model;
  source::NameTable& names;
  source::DiagnosticSink& sink;
  ValueOfCall& value_of_call;
  std::unordered_map<std::uint32_t, const Type*> types;  // user types by NameId; null: wrong declaration
  std::unordered_map<std::uint32_t, Pou*> pous;
  std::unordered_map<std::uint32_t, std::uint32_t> globals;  // NameId -> index into model.globals
  std::unordered_map<std::uint32_t, EnumValue> enum_values;
  // Direct variables with a type of their own (AT %MW0 : INT, without a name).
  std::vector<std::pair<syntax::DirectAddress, const Type*>> direct_types;
  // Blocks of programs that tasks of their own run (6.8.2): a call in the body passes arguments only.
  std::unordered_map<const Pou*, std::vector<NameId>> run_by_tasks;

  // Unknown names that have been reported, by the POU that uses them.
  std::set<std::pair<const Pou*, std::string>> unknown = {};
  // In first values a reference that is not NULL is the number of its target here, from 1, until the value
  // lies in an area.
  std::vector<FirstTarget> first_targets = {};
  // The enumeration that is being declared: in the values of its names the names before are numbers
  // (6.4.4.2).
  const Type* numbered = nullptr;
  const source::Dialect* dialect = &source::standard_dialect();
  std::set<std::uint32_t> list_names = {};  // NameIds of configurations and resources

  void error(const char* what, Position where, std::string message, std::string hint = {}) {
    sink.error(what, where, std::move(message), std::move(hint));
  }
  // A name that means nothing: said once in each POU, as one declaration mends all uses. No POU: once at all.
  void unknown_name(const char* what, const Pou* pou, Position where, std::string message,
                    std::string hint = {}) {
    if (unknown.emplace(pou, message).second) error(what, where, std::move(message), std::move(hint));
  }

  TypeTable& type_table() { return model.types; }

  // The value of a constant of the type, for where it is used; nothing if it is no value of its own or not
  // known before the areas have their addresses.
  std::optional<Constant> folded_value(const Type& type, std::span<const std::byte> bytes) const;

  // first_reference.cpp
  // The number of a direct place; `pou` is the one whose variables are being laid out.
  Constant add_first_target(const Place& place, const Pou* pou);
  // Null if a first value of the type is no reference, or NULL.
  const FirstTarget* first_target(const Constant& value, const Type& type) const;
  // The first value of a variable of the type was put there: its references become known to the model.
  void note_references(const Type& type, std::span<const std::byte> bytes, Base base, std::uint32_t offset,
                       Position where);

  // `size` bytes of Data, zero; nothing and a report if the program gets too large.
  std::optional<std::uint32_t> allocate(std::uint32_t size, Position where);
  // A place in Data for a value of the type, with the type's initial value.
  Place allocate_place(const Type* type, Position where);
  // The same, with first bytes of its own.
  Place allocate_place(const Type* type, std::span<const std::byte> initial, Position where);
};

// A place in the frame of the running POU: it begins anew, with whatever was there before.
Place frame_place(Pou& pou, const Type* type);

// Bytes that a program may have.
inline constexpr std::uint32_t kMaxData = 32u << 20;

std::string quote(std::string_view name);
// The name of the type for a message: of a string without its length, which matters to no rule.
const std::string& plain_name(const Type& type);

}  // namespace stepwright::semantics::internal
