// Parts of bit strings: word.%X3, word.3, dword.%W1 (IEC 61131-3, 6.5.3.2, table 17).

#include <utility>

#include "ladder/semantics/expressions/places.h"

namespace stepwright::semantics::internal {

using syntax::Expression;

namespace {

ElementaryType part_type(std::uint8_t bits) {
  switch (bits) {
    case 1:
      return ElementaryType::Bool;
    case 8:
      return ElementaryType::Byte;
    case 16:
      return ElementaryType::Word;
    case 32:
      return ElementaryType::Dword;
    default:
      return ElementaryType::Lword;
  }
}

}  // namespace

std::optional<Place> Places::partial_place(const Expression& expression) {
  std::optional<Place> base = part(*expression.operands[0]);
  if (!base) return std::nullopt;
  const Type& whole = *base->type;
  const bool is_number = whole.kind == TypeKind::Elementary && whole.is_integer();
  if (!whole.is_bits() && !(is_number && a_.dialect->integer_parts)) {
    a_.error(code::kBadOperand, expression.where, whole.name + " has no parts that could be picked out",
             is_number
                 ? source::with_dialects("convert it to a bit string first, with " + whole.name + "_TO_WORD",
                                         &source::Dialect::integer_parts)
                 : "");
    return std::nullopt;
  }
  const unsigned parts = whole.bit_count() / expression.part_bits;
  if (expression.part_bits >= whole.bit_count() && expression.part_bits != 8 * whole.size) {
    a_.error(code::kConstantIndex, expression.where, "the part is larger than " + whole.name);
    return std::nullopt;
  }
  if (expression.integer >= parts) {
    a_.error(code::kConstantIndex, expression.where,
             whole.name + " has no part " + std::to_string(expression.integer),
             "its parts of this size go from 0 to " + std::to_string(parts - 1));
    return std::nullopt;
  }
  const auto bit = static_cast<std::uint32_t>(expression.integer) * expression.part_bits;
  const Type* type = a_.type_table().elementary(part_type(expression.part_bits));
  if (base->base == Base::Slot && base->steps.empty()) {
    if (base->whole == nullptr) base->whole = &whole;
    base->shift = static_cast<std::uint8_t>(base->shift + bit);
  } else {
    // Little-endian: the lower parts come first in memory.
    advance(*base, bit / 8);
    if (expression.part_bits == 1) base->bit = static_cast<std::uint8_t>(bit % 8);
  }
  base->type = type;
  return base;
}

}  // namespace stepwright::semantics::internal
