#pragma once

// Syntax expressions -> values. A function that returns null or nothing has reported why (or met something
// that was reported before), so callers stay silent.

#include <optional>

#include "ladder/semantics/internal/analysis.h"
#include "ladder/semantics/internal/make_value.h"
#include "ladder/semantics/statement.h"

namespace stepwright::semantics::internal {

enum class Access : std::uint8_t { Read, Write };

// Meaning of a conversion's name; `from` is null where the argument decides.
struct NamedConversion {
  enum class Kind : std::uint8_t { Convert, Truncate, FromBcd, ToBcd };
  Kind kind = Kind::Convert;
  const Type* from = nullptr;
  const Type* to = nullptr;
};

class ExpressionAnalyzer {
 public:
  // `pou` is null outside of POUs (bounds, initial values of globals): only constants are known there.
  ExpressionAnalyzer(Analysis& analysis, Pou* pou) : a_(analysis), pou_(pou) {}

  // A value of whatever type it has; literals keep their literal type.
  ValuePtr value(const syntax::Expression& expression);
  // The value, implicitly converted to `type`.
  ValuePtr value_as(const syntax::Expression& expression, const Type* type);
  // As value(), but literals get the type that they have without a context: INT, DINT, LINT, REAL.
  ValuePtr settled_value(const syntax::Expression& expression);
  // A BOOL value; `what` for the message ("the condition of IF").
  ValuePtr condition(const syntax::Expression& expression, const char* what);
  // A constant of the type.
  std::optional<Constant> constant(const syntax::Expression& expression, const Type* type);
  // A constant integer, whatever its type.
  std::optional<std::int64_t> constant_integer(const syntax::Expression& expression);
  // A variable or a part of one.
  std::optional<Place> place(const syntax::Expression& expression, Access access);
  // The first value of a variable of a scalar type.
  ValuePtr first_value(const Constant& value, const Type* type, Position where) const;

  // Implicit conversion; reports at `where` if there is none.
  ValuePtr convert(ValuePtr value, const Type* type, Position where);

  // Parts of calls of standard functions.

  // Conversion as the standard's X_TO_Y; requires one that the language has. Folds constants.
  ValuePtr convert_exactly(ValuePtr value, const Type* type) const;
  // An elementary type by its name in upper case, or a string of any length; null if it names none.
  const Type* named_type(const std::string& folded) const;
  // "expected X, found Y"; null.
  ValuePtr mismatch(const Type& from, const Type& to, Position where);
  // A literal gets the type that it has without a context: INT, DINT, LINT, REAL.
  ValuePtr settle(ValuePtr value);
  // The narrowest type that holds every value of both; null if there is none.
  const Type* common_type(const Value& left, const Value& right) const;
  bool operator_applies(syntax::Operator op, const Type& type) const;
  ValuePtr combine(syntax::Operator op, ValuePtr left, ValuePtr right, Position where);
  ValuePtr invert(ValuePtr operand, Position where);
  ValuePtr power(ValuePtr base, ValuePtr exponent, Position where);
  // A number as REAL, or as LREAL if REAL does not hold all values of its type.
  ValuePtr as_real(ValuePtr value);
  // An operation on strings, or one that makes one; folded if the operands are constants and it has a value.
  // `narrow` is the operation on STRING. A string as result has the capacity of `type`.
  ValuePtr text_operation(bytecode::StringOpId narrow, const Type* type, std::vector<ValuePtr> operands,
                          Position where);
  ValuePtr text_operation(bytecode::StringOpId narrow, const Type* type, ValuePtr operand, Position where);
  // A real as an integer, towards zero.
  ValuePtr truncated(ValuePtr value, const Type* type, const syntax::Expression& call);

  // bit_arithmetic.cpp
  // A bit string as the number that it is where the dialect has them so; all else as it is.
  ValuePtr counted(ValuePtr value) const;
  // An integer as a bit string of its size, or of `bytes` if that is more, where the dialect has them so.
  ValuePtr as_bits(ValuePtr value, std::uint32_t bytes = 0) const;
  // Whether values are converted bit by bit, where the dialect has bit strings as numbers.
  bool exchanges_bits(const Type& from, const Type& to) const;
  // The hint where a bit string is no number: a dialect may have it so.
  std::string bits_hint(const Type& type, std::string hint = {}) const;

  // Lookup for calls.

  std::optional<Place> variable_place(const syntax::Name& name);
  const Variable* find_variable(NameId name) const;
  void report_unknown(const syntax::Name& name);
  // Does it stand in a TEST, which sees more than a program (test_place.cpp)?
  bool in_test() const { return pou_ != nullptr && pou_->test != nullptr; }
  // REF(x)
  ValuePtr reference_to(const syntax::Expression& call);
  // LOWER_BOUND, UPPER_BOUND
  ValuePtr array_bound(const syntax::Expression& call, bool upper);
  // X_TO_Y and its like; nothing if the name is none of them.
  std::optional<NamedConversion> named_conversion(const std::string& folded) const;
  ValuePtr explicit_conversion(const syntax::Expression& call, const NamedConversion& conversion);

  const Pou* pou() const { return pou_; }

 private:
  // expression_analyzer.cpp
  ValuePtr literal(const syntax::Expression& expression);
  ValuePtr typed_literal(const syntax::Expression& expression);
  ValuePtr variable(const syntax::Expression& expression);
  ValuePtr enum_value(const syntax::Expression& expression);

  // place.cpp
  std::optional<Place> part(const syntax::Expression& expression);
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
  // Forms of other systems with a dot: Color.Red, List.x; null and nothing where it is neither.
  ValuePtr dotted_enumerator(const syntax::Expression& expression, bool& known);
  const Variable* qualified_global(const syntax::Expression& expression);
  bool is_list_of(const Variable& global, const syntax::Name& list) const;
  Place known_place(const Variable& found, const syntax::Name& name);

  // test_place.cpp: what a TEST sees beside what a program sees.
  // The instance of a program that a task runs.
  std::optional<Place> program_instance(const syntax::Name& name) const;
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
  // partial_access.cpp
  std::optional<Place> partial_place(const syntax::Expression& expression);
  // reference.cpp
  std::optional<Place> followed_place(const syntax::Expression& expression);
  // A literal 0 beside a reference as NULL, where the dialect has pointers; all else as it is.
  ValuePtr null_beside(ValuePtr value, const Value& other) const;
  // array_bounds.cpp
  std::optional<std::vector<const syntax::Expression*>> plain_arguments(
      const syntax::Expression& call, std::initializer_list<const char*> formals, std::size_t count);

  // derived_conversion.cpp: the types that are no elementary ones; `known` is false for those.
  ValuePtr convert_derived(ValuePtr value, const Type* type, Position where, bool& known);
  ValuePtr convert_enumerator(ValuePtr value, const Type* type, Position where);
  ValuePtr convert_to_subrange(ValuePtr value, const Type* type, Position where);

  // text.cpp
  ValuePtr text_literal(const syntax::Expression& expression);
  const Type* common_text(const Value& left, const Value& right) const;
  ValuePtr compare_texts(syntax::Operator op, ValuePtr left, ValuePtr right, Position where);
  ValuePtr convert_text(ValuePtr value, const Type* type, Position where);
  std::optional<Place> character_place(Place text, const syntax::Expression& expression);
  // text_conversion.cpp
  ValuePtr text_conversion(ValuePtr value, const Type* to, const syntax::Expression& call);
  ValuePtr to_text(ValuePtr value, const Type* to, const syntax::Expression& call);
  ValuePtr no_conversion(const Type& from, const Type& to, const syntax::Expression& call,
                         std::string hint = {});

  // operators.cpp
  ValuePtr unary(const syntax::Expression& expression);
  ValuePtr unary(syntax::Operator op, ValuePtr operand, Position where);
  ValuePtr binary(const syntax::Expression& expression);
  ValuePtr combine_time(syntax::Operator op, ValuePtr left, ValuePtr right, Position where);
  ValuePtr scale_time(syntax::Operator op, ValuePtr left, ValuePtr right, Position where);
  ValuePtr within_day(ValuePtr value);
  ValuePtr fold_literals(syntax::Operator op, const Value& left, const Value& right, Position where);
  ValuePtr bad_operands(syntax::Operator op, const Value& left, const Value& right, Position where);

  // bit_arithmetic.cpp
  // The bit string, or the unsigned integer, of so many bytes.
  const Type* whole_type(std::uint32_t bytes, bool bits) const;
  const Type& type_beside(const Value& value, const Value& other) const;
  std::uint32_t whole_size(const Value& value) const;
  static bool works_on_bits(syntax::Operator op, const Type& left, const Type& right);
  ValuePtr combine_bits(syntax::Operator op, ValuePtr left, ValuePtr right, Position where);

  // conversion.cpp
  ValuePtr convert_literal(ValuePtr value, const Type* type, Position where);
  ValuePtr retype(ValuePtr value, const Type* type, Position where);
  ValuePtr through_unsigned(ValuePtr value, const Type* to);
  // Values whose type depends on where they stand (Value::adapts).
  static bool adapts_to(const Value& value, const Type& type);
  ValuePtr adapted(ValuePtr value, const Type* type);
  ValuePtr bcd_conversion(ValuePtr value, const NamedConversion& conversion, const syntax::Expression& call);

  Analysis& a_;
  Pou* pou_;
  // Why the place that is being resolved cannot be written, and where to say so; empty if it can.
  Protection read_only_;
  Position read_only_where_;
};

}  // namespace stepwright::semantics::internal
