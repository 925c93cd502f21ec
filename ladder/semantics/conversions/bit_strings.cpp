// Bit strings beside numbers, where the dialect has them (Dialect::bits_calculate): a bit string is the
// unsigned integer of its bits where a number stands, an integer the bit string of its bits where one stands.

#include "ladder/semantics/conversions/bit_strings.h"

#include <algorithm>
#include <utility>

#include "ladder/semantics/constants/constant_conversion.h"
#include "ladder/semantics/conversions/make_value.h"
#include "ladder/semantics/types/operator_group.h"

namespace stepwright::semantics::internal {

using syntax::Operator;

namespace {

bool is_whole(const Type& type) {
  return type.is_bits() || type.is_integer();
}

// An integer that is no literal: a literal is a bit string or an integer, as its place says.
bool is_typed_integer(const Type& type) {
  return type.kind == TypeKind::Elementary && type.is_integer();
}

}  // namespace

const Type* BitStrings::whole_type(std::uint32_t bytes, bool bits) const {
  using enum ElementaryType;
  return a_.type_table().elementary(bytes == 1   ? (bits ? Byte : Usint)
                                    : bytes == 2 ? (bits ? Word : Uint)
                                    : bytes == 4 ? (bits ? Dword : Udint)
                                                 : (bits ? Lword : Ulint));
}

bool BitStrings::exchanges_bits(const Type& from, const Type& to) const {
  if (is_typed_integer(from) && to.is_bits()) return to.bit_count() >= from.bit_count();
  if (!from.is_bits()) return false;
  if (is_typed_integer(to)) return to.bit_count() >= from.bit_count();
  return to.is_real() && widens(*whole_type(from.size, false), to);
}

ValuePtr BitStrings::counted(ValuePtr value) const {
  if (!value || !a_.dialect->bits_calculate || !value->type->is_bits()) return value;
  const Type* number = whole_type(value->type->size, false);
  return convert_exactly(std::move(value), number);
}

ValuePtr BitStrings::as_bits(ValuePtr value, std::uint32_t bytes) const {
  if (!value || !a_.dialect->bits_calculate || !is_typed_integer(*value->type)) return value;
  const Type* bits = whole_type(std::max(value->type->size, bytes), true);
  return convert_exactly(std::move(value), bits);
}

std::string BitStrings::bits_hint(const Type& type, std::string hint) const {
  if (!type.is_bits() || a_.dialect->bits_calculate) return hint;
  return source::with_dialects(std::move(hint), &source::Dialect::bits_calculate);
}

const Type& BitStrings::type_beside(const Value& value, const Value& other) const {
  const Type& type = *value.type;
  if (!a_.dialect->bits_calculate || !type.is_bits() || !other.type->is_number()) return type;
  const bool is_code = other.type->kind == TypeKind::AnyInteger && fits(other.constant, type);
  return is_code ? type : *whole_type(type.size, false);
}

std::uint32_t BitStrings::whole_size(const Value& value) const {
  if (!value.type->is_literal()) return value.type->size;
  for (const std::uint32_t bytes : {1u, 2u, 4u})
    if (fits({std::max(value.constant.integer, -(value.constant.integer + 1))}, *whole_type(bytes, true)))
      return bytes;
  return 8;
}

bool BitStrings::works_on_bits(Operator op, const Type& left, const Type& right) {
  if (!is_whole(left) || !is_whole(right)) return false;
  if (is_arithmetic(op)) return left.is_bits() || right.is_bits();
  return is_logic(op) && !is_short_circuit(op) && (is_typed_integer(left) || is_typed_integer(right));
}

}  // namespace stepwright::semantics::internal
