// Bit string functions (IEC 61131-3, 6.6.2.5.8, table 30), validity of BCD (table 39), byte order (table 38).

#include <utility>

#include "ladder/semantics/standard_functions/standard_analyzer.h"

namespace stepwright::semantics::internal {

using syntax::Expression;

namespace {

constexpr int id(StandardFunction function) {
  return static_cast<int>(function);
}

}  // namespace

std::span<const StandardAnalyzer::Entry> StandardAnalyzer::bit_entries() {
  using enum StandardFunction;
  using S = StandardAnalyzer;
  static constexpr Entry kEntries[] = {
      {"SHL", "IN N", 2, &S::shift, id(Shl), 0, 1},
      {"SHR", "IN N", 2, &S::shift, id(Shr), 0, 1},
      {"ROL", "IN N", 2, &S::shift, id(Rol), 0, 1},
      {"ROR", "IN N", 2, &S::shift, id(Ror), 0, 1},
      {"IS_VALID_BCD", "IN", 1, &S::is_valid_bcd, 0, 0, 1},
      {"TO_BIG_ENDIAN", "IN", 1, &S::swap_bytes, 1, 0, 0},
      {"FROM_BIG_ENDIAN", "IN", 1, &S::swap_bytes, 1, 0, 0},
      {"BIG_ENDIAN_TO", "IN", 1, &S::swap_bytes, 1, 0, 0},
      {"TO_LITTLE_ENDIAN", "IN", 1, &S::swap_bytes, 0, 0, 0},
      {"FROM_LITTLE_ENDIAN", "IN", 1, &S::swap_bytes, 0, 0, 0},
      {"LITTLE_ENDIAN_TO", "IN", 1, &S::swap_bytes, 0, 0, 0},
  };
  return kEntries;
}

ValuePtr StandardAnalyzer::shift(const Expression& call, Values values, int which) {
  const auto function = static_cast<StandardFunction>(which);
  // What SHR moves into a signed integer is its sign on some systems and 0 on others.
  const Type& given = *values[0]->type;
  const bool is_code = given.kind == TypeKind::Elementary && given.is_integer() &&
                       (given.is_unsigned() || function != StandardFunction::Shr);
  if (is_code) values[0] = e_.conversions().bits().as_bits(std::move(values[0]));
  if (!values[0]->type->is_bits()) {
    const std::string hint = "it works on BYTE, WORD, DWORD and LWORD; a literal needs a type: WORD#16#1";
    return wrong_operand(call, *values[0]->type,
                         is_code ? source::with_dialects(hint, &source::Dialect::bits_calculate) : hint);
  }
  const bool rotates = function == StandardFunction::Rol || function == StandardFunction::Ror;
  const auto bits = static_cast<__int128>(values[0]->type->bit_count());
  const Type* count = values[1]->type;
  const bool is_long = count->kind == TypeKind::Elementary && count->is_integer() &&
                       !widens(*count, *a_.type_table().elementary(ElementaryType::Dint));
  if (rotates && is_long) {
    const Position where = values[1]->where;
    // A negative number stays one.
    const IntegerRange range = range_of(count->elementary);
    if (!count->is_unsigned()) values[1] = bounded(std::move(values[1]), -1, range.high);
    values[1] = e_.operators().combine(syntax::Operator::Modulo, std::move(values[1]),
                                       make_constant({bits}, count, where), where);
  }
  values[1] = as_dint(std::move(values[1]), -1, bits);
  if (!values[1]) return nullptr;
  if (values[1]->kind == ValueKind::Constant && values[1]->constant.integer < 0) {
    a_.error(code::kOutOfRange, values[1]->where, "the number of places is negative",
             "shift the other way instead");
    return nullptr;
  }
  const Type* type = values[0]->type;
  ValuePtr result = make_standard(function, type, std::move(values), call.where);
  if (result->kind == ValueKind::Standard) result->kind = ValueKind::Shift;
  return result;
}

ValuePtr StandardAnalyzer::is_valid_bcd(const Expression& call, Values values, int) {
  if (!values[0]->type->is_bits())
    return wrong_operand(call, *values[0]->type, "it works on BYTE, WORD, DWORD and LWORD");
  return make_standard(StandardFunction::IsValidBcd, a_.type_table().boolean(), std::move(values),
                       call.where);
}

// The machine is little-endian, so TO_LITTLE_ENDIAN changes nothing.
ValuePtr StandardAnalyzer::swap_bytes(const Expression& call, Values values, int which) {
  values[0] = e_.conversions().settle(std::move(values[0]));
  if (!values[0]) return nullptr;
  const Type* type = values[0]->type;
  const bool has_bytes = type->is_integer() || type->is_bits() || type->is_time();
  if (!has_bytes || type->is_real())
    return wrong_operand(call, *type, "it works on integers, bit strings and TIME");
  if (which == 0 || type->size == 1) return std::move(values[0]);
  return make_standard(StandardFunction::SwapBytes, type, std::move(values), call.where);
}

}  // namespace stepwright::semantics::internal
