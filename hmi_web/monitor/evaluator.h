#pragma once

// The value of an expression from the values of one scan. Types, conversions and arithmetic are those of the
// compiler's constants (ladder/semantics), which are the machine's.
//
//   Evaluator evaluator(types, lookup);
//   Value power = evaluator.value(*condition);
//
// Holds references only; one thread.

#include <span>
#include <string_view>

#include "hmi_web/monitor/value.h"
#include "ladder/semantics/constants/constant_function.h"
#include "ladder/syntax/expression.h"

namespace stepwright::monitor {

class Evaluator {
 public:
  // Both outlive it.
  Evaluator(const semantics::TypeTable& types, const Lookup& lookup) : types_(types), lookup_(lookup) {}

  Value value(const syntax::Expression& expression) const;
  // None of a null.
  Value value(const syntax::Expression* expression) const {
    return expression == nullptr ? std::nullopt : value(*expression);
  }
  // What a variable stands for at this moment: "a[2].x" of a[i].x. None if an index is not known, and of what
  // is no variable.
  std::optional<std::string> path(const syntax::Expression& expression) const;
  Value combine(syntax::Operator op, const Value& left, const Value& right) const;
  Value invert(const Value& value) const;
  // Of a function that keeps no state; none of those that are not the standard's.
  Value call(std::string_view name, std::span<const Value> inputs) const;
  Value boolean(bool value) const { return Known{types_.boolean(), {value ? 1 : 0}}; }

 private:
  Value literal(const syntax::Expression& expression, bytecode::ElementaryType type) const;
  Value number(const syntax::Expression& expression, const semantics::Type* otherwise) const;
  Value unary(syntax::Operator op, const Value& operand) const;
  Value logic(syntax::Operator op, const Value& left, const Value& right) const;
  Value power(const Known& base, const Known& exponent) const;
  Value duration(syntax::Operator op, const Known& left, const Known& right) const;
  Value to_type(const Known& value, const semantics::Type* type) const;
  Value fold(syntax::Operator op, std::span<const Value> inputs) const;
  Value chain(syntax::Operator op, std::span<const Value> inputs) const;
  Value function(semantics::StandardFunction which, std::span<const Value> inputs) const;
  Value real_function(semantics::StandardFunction which, const Value& input) const;
  Value converted(std::string_view name, const Value& input) const;

  const semantics::TypeTable& types_;
  const Lookup& lookup_;
};

}  // namespace stepwright::monitor
