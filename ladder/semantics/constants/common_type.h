#pragma once

// The type in which an operator computes two operands of different types. Pure.
//
//   const Type* type = common_type(types, {*left.type, left.constant}, {*right.type, right.constant});

#include "ladder/semantics/types/constant.h"
#include "ladder/semantics/types/type.h"

namespace stepwright::semantics {

struct Operand {
  const Type& type;
  const Constant& constant;  // of a literal: its value; of anything else not looked at
};

// The narrowest type that holds every value of both, numbers and bit strings; a literal takes the type of the
// other one if that has its value. Null if there is none.
const Type* common_type(const TypeTable& types, const Operand& left, const Operand& right);

}  // namespace stepwright::semantics
