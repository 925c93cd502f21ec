#include "ladder/semantics/conversions/make_value.h"

#include <algorithm>
#include <utility>

#include "ladder/semantics/constants/constant_conversion.h"
#include "ladder/semantics/constants/constant_function.h"

namespace stepwright::semantics::internal {

ValuePtr make(ValueKind kind, const Type* type, source::Position where) {
  auto value = std::make_unique<Value>();
  value->kind = kind;
  value->type = type;
  value->where = where;
  return value;
}

ValuePtr make_constant(Constant constant, const Type* type, source::Position where) {
  ValuePtr value = make(ValueKind::Constant, type, where);
  value->constant = constant;
  return value;
}

ValuePtr load(Place place, source::Position where) {
  const bool is_subrange = place.type->kind == TypeKind::Subrange;
  ValuePtr value = make(ValueKind::Load, is_subrange ? place.type->base : place.type, where);
  value->place = std::move(place);
  return value;
}

Place copy_direct(const Place& place) {
  Place copy;
  copy.base = place.base;
  copy.offset = place.offset;
  copy.slot = place.slot;
  copy.bit = place.bit;
  copy.type = place.type;
  copy.whole = place.whole;
  copy.shift = place.shift;
  copy.open = place.open;
  return copy;
}

void advance(Place& place, std::uint32_t offset) {
  if (place.is_direct()) {
    place.offset += offset;
  } else if (offset != 0) {
    PlaceStep step;
    step.offset = offset;
    place.steps.push_back(std::move(step));
  }
}

ValuePtr convert_exactly(ValuePtr value, const Type* type) {
  if (value->type == type) return value;
  if (value->kind == ValueKind::Constant) {
    if (const auto constant = converted(value->constant, *value->type, *type))
      return make_constant(*constant, type, value->where);
  }
  ValuePtr result = make(ValueKind::Convert, type, value->where);
  result->operands.push_back(std::move(value));
  return result;
}

ValuePtr make_standard(StandardFunction function, const Type* type, std::vector<ValuePtr> values,
                       source::Position where) {
  const bool constant = std::ranges::all_of(values, [](const ValuePtr& each) {
    return each->kind == ValueKind::Constant && !each->type->is_string();
  });
  if (constant) {
    std::vector<Constant> operands;
    for (const ValuePtr& each : values) operands.push_back(each->constant);
    if (const auto folded = evaluate(function, operands, *values.front()->type, *type))
      return make_constant(*folded, type, where);
  }
  ValuePtr result = make(ValueKind::Standard, type, where);
  result->function = function;
  if (type->is_literal()) result->constant = widest_of(values);
  result->operands = std::move(values);
  return result;
}

}  // namespace stepwright::semantics::internal
