#pragma once

// Strings known at compile time: what the machine's string operations give.

#include <optional>
#include <span>

#include "ladder/semantics/types/constant.h"
#include "runtime/bytecode/opcode.h"

namespace stepwright::semantics {

// The value of an operation, in `result`; a text is cut to its capacity. `narrow` is the operation on STRING,
// whatever the width. Nothing if the machine would trap. Concat takes two texts or more, SetCharAt makes a
// text of one character.
std::optional<Constant> evaluate_text(bytecode::StringOpId narrow, std::span<const Constant> operands,
                                      const Type& result);

// -1, 0 or 1; by code unit, as the machine compares.
int compare_texts(const std::u16string& left, const std::u16string& right);

}  // namespace stepwright::semantics
