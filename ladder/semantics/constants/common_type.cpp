#include "ladder/semantics/constants/common_type.h"

namespace stepwright::semantics {

namespace {

// Of a literal and another type; null if the literal is an integer that the type does not hold.
const Type* beside_literal(const TypeTable& types, const Operand& literal, const Type& other) {
  if (other.is_literal()) return types.any_real();
  if (literal.type.kind == TypeKind::AnyReal) {
    if (other.is_real()) return &other;
    if (!other.is_integer()) return nullptr;
    return types.elementary(widens(other, *types.elementary(ElementaryType::Real)) ? ElementaryType::Real
                                                                                   : ElementaryType::Lreal);
  }
  if (other.is_real()) return &other;
  const bool takes_integers = other.is_integer() || other.is_bits() || other.is_bool();
  return takes_integers && fits(literal.constant, other) ? &other : nullptr;
}

bool takes(const Type& candidate, const Operand& operand) {
  return operand.type.is_literal() ? candidate.is_integer() && fits(operand.constant, candidate)
                                   : widens(operand.type, candidate);
}

}  // namespace

const Type* common_type(const TypeTable& types, const Operand& left, const Operand& right) {
  if (&left.type == &right.type) return &left.type;
  if (left.type.is_literal() || right.type.is_literal()) {
    const Operand& literal = left.type.is_literal() ? left : right;
    const Type& other = left.type.is_literal() ? right.type : left.type;
    if (const Type* type = beside_literal(types, literal, other)) return type;
    if (literal.type.kind == TypeKind::AnyReal || !other.is_integer()) return nullptr;
  }
  for (const auto which :
       {ElementaryType::Sint, ElementaryType::Usint, ElementaryType::Int, ElementaryType::Uint,
        ElementaryType::Dint, ElementaryType::Udint, ElementaryType::Lint, ElementaryType::Ulint,
        ElementaryType::Byte, ElementaryType::Word, ElementaryType::Dword, ElementaryType::Lword,
        ElementaryType::Real, ElementaryType::Lreal}) {
    const Type& candidate = *types.elementary(which);
    if (takes(candidate, left) && takes(candidate, right)) return &candidate;
  }
  return nullptr;
}

}  // namespace stepwright::semantics
