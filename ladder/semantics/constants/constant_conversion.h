#pragma once

// Conversions of constants (X_TO_Y): what the machine would compute.

#include <optional>

#include "ladder/semantics/types/constant.h"

namespace stepwright::semantics {

// Nanoseconds in the unit in which a duration or a date counts when it becomes a number: milliseconds for
// TIME and TOD, seconds for DATE and DT.
std::int64_t time_unit_ns(const Type& time_or_date);

// Whether a conversion keeps the bits and not the number: between REAL and DWORD, LREAL and LWORD (table 26).
bool transfers_bits(const Type& from, const Type& to);

// WCHAR_TO_CHAR: as with strings, a character that the narrow type does not hold becomes one that says so
// (table 27 leaves open which).
bool is_narrowed_character(const Type& from, const Type& to);
inline constexpr char kNoCharacter = '?';

// Nothing if the machine would trap (a real out of range), or if there is no such conversion of constants.
std::optional<Constant> converted(const Constant& value, const Type& from, const Type& to);

}  // namespace stepwright::semantics
