// Conversions that a program asks for by name (IEC 61131-3, 6.6.2.5.3 to 6.6.2.5.5, tables 22 to 27).

#include "ladder/semantics/conversions/explicit_conversions.h"

#include <cmath>
#include <utility>

#include "ladder/semantics/constants/constant_conversion.h"
#include "ladder/semantics/conversions/text.h"

namespace stepwright::semantics::internal {
namespace {

bool is_date(const Type& type) {
  return type.is(ElementaryType::Date) || type.is(ElementaryType::Tod) || type.is(ElementaryType::Dt);
}

// REAL_TO_WORD and its like: the standard has them only where the bits are transferred.
bool rounds_to_bits(const Type& from, const Type& to) {
  return ((from.is_real() && to.is_bits()) || (from.is_bits() && to.is_real())) && !transfers_bits(from, to);
}

// Whether X_TO_Y exists.
bool convertible(const Type& from, const Type& to) {
  if (&from == &to) return true;
  const auto is_count = [](const Type& type) { return type.is_number() || type.is_bits(); };
  const auto is_plain = [&](const Type& type) { return is_count(type) || type.is_bool(); };
  const bool real_and_bits = (from.is_real() && to.is_bits()) || (from.is_bits() && to.is_real());
  if (real_and_bits) return transfers_bits(from, to);
  if (is_plain(from) && is_plain(to)) return true;
  const auto is_time = [](const Type& type) { return type.is_time() || is_date(type); };
  if (is_time(from) && is_time(to))
    return (from.is(ElementaryType::Dt) && !to.is_time()) ||
           (from.is(ElementaryType::Date) && to.is(ElementaryType::Dt));
  if ((is_time(from) && is_count(to)) || (is_count(from) && is_time(to))) return true;
  const auto is_code = [](const Type& type) { return type.is_integer() || type.is_bits(); };
  return (is_character(from) || is_code(from)) && (is_character(to) || is_code(to));
}

}  // namespace

ValuePtr ExplicitConversions::truncated(ValuePtr value, const Type* type, const syntax::Expression& call) {
  value = c_.settle(std::move(value));
  if (!value) return nullptr;
  if (!value->type->is_real() || !type->is_integer()) {
    const Type& wrong = value->type->is_real() ? *type : *value->type;
    a_.error(code::kBadOperand, call.where, quote(call.name.text) + " cannot be applied to " + wrong.name,
             "it cuts the fraction of a REAL or LREAL off");
    return nullptr;
  }
  if (value->kind == ValueKind::Constant && std::abs(value->constant.real) < 1e19) {
    const Constant whole{static_cast<__int128>(std::trunc(value->constant.real))};
    if (fits(whole, *type)) return make_constant(whole, type, call.where);
  }
  ValuePtr result = make(ValueKind::Truncate, type, call.where);
  result->operands.push_back(std::move(value));
  return result;
}

// REAL_TO_WORD rounds to a UINT, whose bits the WORD has; WORD_TO_REAL the other way.
ValuePtr ExplicitConversions::through_unsigned(ValuePtr value, const Type* to) {
  const std::uint32_t bytes = to->is_bits() ? to->size : value->type->size;
  ValuePtr whole = convert_exactly(std::move(value), c_.bits().whole_type(bytes, false));
  whole = convert_exactly(std::move(whole), to);
  whole->converts_part = true;
  return whole;
}

// An elementary type, or a string of any length; null if the name is none of them.
const Type* ExplicitConversions::named_type(const std::string& folded) const {
  for (const auto which : {ElementaryType::String, ElementaryType::Wstring})
    if (folded == bytecode::name_of(which))
      return a_.type_table().string(which, bytecode::kMaxStringCapacity);
  ElementaryType which{};
  return elementary_from(folded, which) ? a_.type_table().elementary(which) : nullptr;
}

std::optional<NamedConversion> ExplicitConversions::named_conversion(const std::string& folded) const {
  using Kind = NamedConversion::Kind;
  struct Pattern {
    std::string_view middle;
    Kind kind;
  };
  // Longer patterns before the ones that they contain.
  static constexpr Pattern kPatterns[] = {{"_BCD_TO_", Kind::FromBcd},
                                          {"_TO_BCD_", Kind::ToBcd},
                                          {"_TRUNC_", Kind::Truncate},
                                          {"_TO_", Kind::Convert}};
  // An underscore before the name makes "TO_INT" a pattern like the others, with nothing in front.
  const std::string text = "_" + folded;
  for (const Pattern& each : kPatterns) {
    const std::size_t at = text.find(each.middle);
    if (at == std::string::npos) continue;
    const Type* to = named_type(text.substr(at + each.middle.size()));
    const Type* from = at > 0 ? named_type(text.substr(1, at - 1)) : nullptr;
    if (to == nullptr || (at > 0 && from == nullptr)) return std::nullopt;
    return NamedConversion{each.kind, from, to};
  }
  return std::nullopt;
}

ValuePtr ExplicitConversions::apply(ValuePtr value, const NamedConversion& conversion,
                                    const syntax::Expression& call) {
  value = conversion.from != nullptr
              ? c_.convert(std::move(value), conversion.from, call.arguments[0].value->where)
              : c_.settle(std::move(value));
  if (!value) return nullptr;
  // An enumeration is converted by its number.
  if (value->type->kind == TypeKind::Enumeration)
    value = convert_exactly(std::move(value), a_.type_table().elementary(value->type->elementary));
  switch (conversion.kind) {
    case NamedConversion::Kind::Truncate:
      return truncated(std::move(value), conversion.to, call);
    case NamedConversion::Kind::Convert:
      break;
    default:
      return bcd_conversion(std::move(value), conversion, call);
  }
  if (value->type->is_string() || conversion.to->is_string())
    return text_conversion(std::move(value), conversion.to, call);
  if (a_.dialect->real_to_bits && rounds_to_bits(*value->type, *conversion.to))
    return through_unsigned(std::move(value), conversion.to);
  if (!convertible(*value->type, *conversion.to))
    return no_conversion(
        *value->type, *conversion.to, call,
        rounds_to_bits(*value->type, *conversion.to)
            ? source::with_dialects("round it to an integer first", &source::Dialect::real_to_bits)
            : "");
  return convert_exactly(std::move(value), conversion.to);
}

// Table 24: between BCD in a bit string and a number.
ValuePtr ExplicitConversions::bcd_conversion(ValuePtr value, const NamedConversion& conversion,
                                             const syntax::Expression& call) {
  const bool reads = conversion.kind == NamedConversion::Kind::FromBcd;
  const Type& code = reads ? *value->type : *conversion.to;
  const Type& number = reads ? *conversion.to : *value->type;
  if (!code.is_bits() || !number.is_integer()) {
    a_.error(code::kBadOperand, call.where,
             quote(call.name.text) + " cannot be applied to " + value->type->name,
             "BCD is in BYTE, WORD, DWORD or LWORD, the number an integer");
    return nullptr;
  }
  std::vector<ValuePtr> operands;
  operands.push_back(std::move(value));
  return make_standard(reads ? StandardFunction::FromBcd : StandardFunction::ToBcd, conversion.to,
                       std::move(operands), call.where);
}

}  // namespace stepwright::semantics::internal
