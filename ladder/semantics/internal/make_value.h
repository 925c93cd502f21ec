#pragma once

// Values and places as they are made of their parts, whatever they are part of.
//
// Thread rule: pure functions.

#include "ladder/semantics/value.h"

namespace stepwright::semantics::internal {

ValuePtr make(ValueKind kind, const Type* type, source::Position where);
ValuePtr make_constant(Constant constant, const Type* type, source::Position where);
// The value in a place; of a subrange it is one of its base.
ValuePtr load(Place place, source::Position where);
// A copy of a place without index steps.
Place copy_direct(const Place& place);
// Goes on to a part of the place that lies `offset` bytes behind its start.
void advance(Place& place, std::uint32_t offset);

}  // namespace stepwright::semantics::internal
