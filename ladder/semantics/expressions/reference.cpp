// References (IEC 61131-3, 6.4.4.10 and table 12): REF(x), r^, r ?= s.

#include <utility>

#include "ladder/semantics/expressions/expression_analyzer.h"

namespace stepwright::semantics::internal {

using syntax::Expression;

namespace {

// A variable that is gone before a reference to it need be, or a parameter, which may stand for one. What a
// reference leads to is not.
bool is_short_lived(const Place& place) {
  for (const PlaceStep& each : place.steps)
    if (each.follow) return false;
  return place.base == Base::Slot || place.base == Base::Frame || place.base == Base::SlotRef ||
         place.base == Base::ThisRef;
}

}  // namespace

// REF(x)
ValuePtr ExpressionAnalyzer::reference_to(const Expression& call) {
  const auto operands = plain_arguments(call, {"IN"}, 1);
  if (!operands) return nullptr;
  const Expression& target = *(*operands)[0];
  // Who holds the reference may write: what cannot be written has none.
  auto found = places_.place(target, Access::Write);
  if (!found) return nullptr;
  if (is_short_lived(*found)) {
    a_.error(code::kShortLived, target.where,
             "the variable is gone or another one when the reference is followed",
             "refer to a variable of a program, a function block or a configuration, not to VAR_TEMP, a "
             "parameter or a variable of a function");
    return nullptr;
  }
  if (!found->is_addressable()) {
    a_.error(code::kNeedsVariable, target.where,
             "a single bit or character has no address that could be referred to");
    return nullptr;
  }
  ValuePtr result = make(ValueKind::Reference, a_.type_table().reference(found->type), call.where);
  result->place = std::move(*found);
  return result;
}

// A reference in a first value is the number of its target (first_reference.cpp).
ValuePtr ExpressionAnalyzer::first_value(const Constant& value, const Type* type, Position where) const {
  const FirstTarget* target = a_.first_target(value, *type);
  if (target == nullptr) return make_constant(value, type, where);
  ValuePtr result = make(ValueKind::Reference, type, where);
  result->place.base = target->owner != nullptr ? Base::This : target->base;
  result->place.offset = target->offset;
  result->place.type = type->element;
  return result;
}

}  // namespace stepwright::semantics::internal
