#pragma once

// Strings and characters as types and values.
//
// Thread rule: pure functions.

#include <vector>

#include "ladder/semantics/model/value.h"
#include "runtime/bytecode/opcode.h"

namespace stepwright::semantics::internal {

// CHAR or WCHAR.
bool is_character(const Type& type);
// STRING for a STRING and a CHAR, WSTRING for the wide ones.
ElementaryType width_of(const Type& type);
// One character as it is written; a constant that happens to hold one is declared as a string.
bool is_single(const Value& value);
// The type of both: the longer string; of a string and a character the string, unless that is one character.
// Null if there is none.
const Type* common_text(const Value& left, const Value& right);
// An operation on strings, or one that makes one; folded if the operands are constants and it has a value.
// `narrow` is the operation on STRING. A string as result has the capacity of `type`.
ValuePtr text_operation(bytecode::StringOpId narrow, const Type* type, std::vector<ValuePtr> operands,
                        source::Position where);
ValuePtr text_operation(bytecode::StringOpId narrow, const Type* type, ValuePtr operand,
                        source::Position where);

}  // namespace stepwright::semantics::internal
