#include "ladder/semantics/internal/make_value.h"

#include <utility>

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

}  // namespace stepwright::semantics::internal
