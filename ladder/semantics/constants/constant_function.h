#pragma once

// Standard functions of constants: what the machine would compute.

#include <optional>
#include <span>

#include "ladder/semantics/model/value.h"
#include "ladder/semantics/types/constant.h"

namespace stepwright::semantics {

// The value of a function of operands of one type (of a shift: the bit string and a count), in `result`;
// nothing if the machine would trap, or the function is not one of constants.
std::optional<Constant> evaluate(StandardFunction function, std::span<const Constant> operands,
                                 const Type& operand_type, const Type& result);

// Of values that are literals: the one that takes the most bits, which stands for them all where a type is
// looked for.
Constant widest_of(std::span<const ValuePtr> values);

}  // namespace stepwright::semantics
