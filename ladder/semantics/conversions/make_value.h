#pragma once

// Values and places as they are made of their parts, whatever they are part of.
//
// Thread rule: pure functions.

#include <vector>

#include "ladder/semantics/model/value.h"

namespace stepwright::semantics::internal {

ValuePtr make(ValueKind kind, const Type* type, source::Position where);
ValuePtr make_constant(Constant constant, const Type* type, source::Position where);
// The value in a place; of a subrange it is one of its base.
ValuePtr load(Place place, source::Position where);
// A copy of a place without index steps.
Place copy_direct(const Place& place);
// Conversion as the standard's X_TO_Y; requires one that the language has. Folds constants.
ValuePtr convert_exactly(ValuePtr value, const Type* type);
// A function of operands, folded if they are constants and the function has a value for them.
ValuePtr make_standard(StandardFunction function, const Type* type, std::vector<ValuePtr> values,
                       source::Position where);
// Goes on to a part of the place that lies `offset` bytes behind its start.
void advance(Place& place, std::uint32_t offset);

}  // namespace stepwright::semantics::internal
