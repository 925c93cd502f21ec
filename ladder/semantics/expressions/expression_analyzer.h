#pragma once

// Syntax expressions -> values. A function that returns null or nothing has reported why (or met something
// that was reported before), so callers stay silent.
//
// Thread rule: one analysis, one thread. Who has an analyzer has its parts: conversions, operators and places
// of the same POU.

#include <optional>

#include "ladder/semantics/analysis/analysis.h"
#include "ladder/semantics/conversions/explicit_conversions.h"
#include "ladder/semantics/conversions/operators.h"
#include "ladder/semantics/conversions/text.h"
#include "ladder/semantics/expressions/places.h"
#include "ladder/semantics/model/statement.h"

namespace stepwright::semantics::internal {

class ExpressionAnalyzer final : private ExpressionValues {
 public:
  // `pou` is null outside of POUs (bounds, initial values of globals): only constants are known there.
  ExpressionAnalyzer(Analysis& analysis, Pou* pou)
      : a_(analysis),
        pou_(pou),
        conversions_(analysis, pou),
        explicit_(analysis, conversions_),
        operators_(analysis, conversions_),
        places_(analysis, pou, conversions_, *this) {}
  // Its parts know each other.
  ExpressionAnalyzer(const ExpressionAnalyzer&) = delete;
  ExpressionAnalyzer& operator=(const ExpressionAnalyzer&) = delete;

  // A value of whatever type it has; literals keep their literal type.
  ValuePtr value(const syntax::Expression& expression) override;
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
  // The first value of a variable of a scalar type.
  ValuePtr first_value(const Constant& value, const Type* type, Position where) const;
  // REF(x)
  ValuePtr reference_to(const syntax::Expression& call);
  // LOWER_BOUND, UPPER_BOUND
  ValuePtr array_bound(const syntax::Expression& call, bool upper);

  Conversions& conversions() { return conversions_; }
  ExplicitConversions& explicit_conversions() { return explicit_; }
  Operators& operators() { return operators_; }
  Places& places() { return places_; }
  const Pou* pou() const { return pou_; }

 private:
  // expression_analyzer.cpp
  ValuePtr literal(const syntax::Expression& expression);
  ValuePtr typed_literal(const syntax::Expression& expression);
  ValuePtr text_literal(const syntax::Expression& expression);
  ValuePtr variable(const syntax::Expression& expression);
  ValuePtr enum_value(const syntax::Expression& expression);
  ValuePtr unary(const syntax::Expression& expression);
  ValuePtr binary(const syntax::Expression& expression);
  // dotted_name.cpp: what other systems write as Color.Red; null and nothing where it is not.
  ValuePtr dotted_enumerator(const syntax::Expression& expression, bool& known);
  // array_bounds.cpp
  std::optional<std::vector<const syntax::Expression*>> plain_arguments(
      const syntax::Expression& call, std::initializer_list<const char*> formals, std::size_t count);

  Analysis& a_;
  Pou* pou_;
  Conversions conversions_;
  ExplicitConversions explicit_;
  Operators operators_;
  Places places_;
};

}  // namespace stepwright::semantics::internal
