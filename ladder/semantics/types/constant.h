#pragma once

// Values known at compile time, and arithmetic on them that gives what the machine would give: integers wrap
// to their type, REAL is computed in single precision.

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "ladder/semantics/types/type.h"
#include "ladder/syntax/expression.h"

namespace stepwright::semantics {

// Integers, bit strings, BOOL (0 or 1), characters, times and dates (ns) and enumerations in `integer`; reals
// in `real`; strings in `text`, each character below 256 in a STRING.
struct Constant {
  __int128 integer = 0;
  double real = 0;
  std::u16string text = {};
};

// Whether the value, an integer of any size, is one of the type's values.
bool fits(const Constant& value, const Type& type);
// The value modulo the width of the type; reals rounded to the type's precision.
Constant wrapped(Constant value, const Type& type);
// The value of an operator on two operands of one type; nothing if it has none (division by zero).
std::optional<Constant> evaluate(syntax::Operator op, const Constant& left, const Constant& right,
                                 const Type& operands);
// Little-endian, as the variable lies in the image; `out` has the size of the type. A text must fit its
// capacity, the header of the string is there already.
void store(const Constant& value, const Type& type, std::span<std::byte> out);
// The value that such bytes stand for.
Constant load(const Type& type, std::span<const std::byte> bytes);
std::string to_string(__int128 value);

}  // namespace stepwright::semantics
