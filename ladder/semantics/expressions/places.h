#pragma once

// Variables and their parts: where they are, and whether they may be written (IEC 61131-3, 6.5).
//
// Thread rule: one analysis, one thread. Nothing means that the reason was reported.

#include <optional>
#include <string>
#include <string_view>

#include "ladder/semantics/conversions/conversions.h"

namespace stepwright::semantics::internal {

enum class Access : std::uint8_t { Read, Write };

// What places need of expressions: the values of indexes.
class ExpressionValues {
 public:
  virtual ~ExpressionValues() = default;
  // A value of whatever type it has; null after a report.
  virtual ValuePtr value(const syntax::Expression& expression) = 0;
};

class Places {
 public:
  // `pou` is null outside of POUs: only constants are known there.
  Places(Analysis& analysis, Pou* pou, Conversions& conversions, ExpressionValues& values)
      : a_(analysis), pou_(pou), c_(conversions), values_(values) {}

  // A variable or a part of one.
  std::optional<Place> place(const syntax::Expression& expression, Access access);
  std::optional<Place> variable_place(const syntax::Name& name);
  const Variable* find_variable(NameId name) const;
  // What other systems write as List.x: the global x, or null.
  const Variable* qualified_global(const syntax::Expression& expression);
  void report_unknown(const syntax::Name& name);
  // For a variable that is called: "a(3)" where a[3] is meant.
  static std::string index_hint(std::string_view name, const Type& type);
  // Does it stand in a TEST, which sees more than a program (test_place.cpp)?
  bool in_test() const { return pou_ != nullptr && pou_->test != nullptr; }
  // Or in a program that watches others?
  bool sees_instances() const { return in_test() || (pou_ != nullptr && pou_->watches); }

 private:
  // place.cpp
  std::optional<Place> part(const syntax::Expression& expression);
  std::optional<Place> followed_place(const syntax::Expression& expression);
  std::optional<Place> field_place(const syntax::Expression& expression);
  std::optional<Place> direct_place(const syntax::Expression& expression);
  struct Member {
    const Type* type = nullptr;
    std::uint32_t offset = 0;
    std::uint8_t bit = bytecode::kNoBit;
  };
  std::optional<Member> struct_member(const Type& type, const syntax::Name& name);
  std::optional<Member> instance_member(const Type& type, const syntax::Name& name);
  struct Protection {
    std::string why;  // empty: it can be written
    std::string hint;
    bool tolerated = false;  // by the dialect, with a warning
  };
  Protection protection(const Variable& variable) const;
  void protect(Position where, std::string why, std::string hint);
  void tolerate(Place& written);
  Place known_place(const Variable& found, const syntax::Name& name);
  // dotted_name.cpp: the name of a configuration, a resource, or of the file that declares the global.
  bool is_list_of(const Variable& global, const syntax::Name& list) const;

  // test_place.cpp: what a TEST, or a program that watches others, sees beside what a program sees.
  // The instance of a program that a task runs.
  std::optional<Place> program_instance(const syntax::Name& name);
  // A program that has no instance because something else is wrong.
  bool is_unconfigured(const syntax::Name& name) const;
  // INSTANCE.Step.X and .T, as the chart of the instance names its steps; nothing, and no report, for others.
  std::optional<Place> step_flag(const syntax::Expression& expression);
  // Any variable of an instance.
  std::optional<Place> inner_place(Place base, const syntax::Expression& expression);

  // index_place.cpp
  std::optional<Place> index_place(const syntax::Expression& expression);
  bool add_index(Place& place, const syntax::Expression& index, const Dimension& dimension,
                 std::uint32_t stride);
  // An integer of any type; null after a report.
  ValuePtr index_value(const syntax::Expression& index);
  ValuePtr narrow_index(ValuePtr value, const Dimension& bounds);
  std::optional<Place> open_index(Place base, const syntax::Expression& expression);
  std::optional<Place> character_place(Place text, const syntax::Expression& expression);
  // partial_access.cpp
  std::optional<Place> partial_place(const syntax::Expression& expression);

  Analysis& a_;
  Pou* pou_;
  Conversions& c_;
  ExpressionValues& values_;
  // Why the place that is being resolved cannot be written, and where to say so; empty if it can.
  Protection read_only_;
  Position read_only_where_;
};

}  // namespace stepwright::semantics::internal
