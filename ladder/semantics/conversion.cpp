// Implicit and explicit conversions (IEC 61131-3, 6.6.1.6 and 6.6.2.5.3 to 6.6.2.5.5, tables 22 to 27).

#include <cmath>
#include <utility>

#include "ladder/semantics/constant_conversion.h"
#include "ladder/semantics/internal/standard_analyzer.h"

namespace stepwright::semantics::internal {

namespace {

std::string conversion_hint(const Type& from, const Type& to) {
  const auto is_text = [](const Type& type) { return type.is_string() || type.kind == TypeKind::Elementary; };
  if (to.is_string() && from.is_string())
    return to.elementary == ElementaryType::Wstring
               ? "literals of WSTRING stand in double quotes; else convert it with STRING_TO_WSTRING(...)"
               : "literals of STRING stand in single quotes; else convert it with WSTRING_TO_STRING(...)";
  if (to.is_string() && is_text(from)) return "convert it with TO_" + plain_name(to) + "(...)";
  if (from.is_string() && is_text(to)) return "convert it with TO_" + to.name + "(...)";
  const bool elementary = from.kind == TypeKind::Elementary && to.kind == TypeKind::Elementary;
  return elementary ? "convert it with " + from.name + "_TO_" + to.name + "(...)" : "";
}

bool is_character(const Type& type) {
  return type.is(ElementaryType::Char) || type.is(ElementaryType::Wchar);
}

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

ValuePtr ExpressionAnalyzer::mismatch(const Type& from, const Type& to, Position where) {
  std::string hint = conversion_hint(from, to);
  if (to.is_time() && from.is_literal()) hint = "durations are written T#1s500ms";
  if (from.kind == TypeKind::AnyReal && to.is_integer()) hint = "round it, or declare the variable as REAL";
  if (exchanges_bits(from, to))
    hint = source::with_dialects(std::move(hint), &source::Dialect::bits_calculate);
  a_.error(code::kTypeMismatch, where, "expected " + plain_name(to) + ", found " + plain_name(from),
           std::move(hint));
  return nullptr;
}

ValuePtr ExpressionAnalyzer::convert(ValuePtr value, const Type* type, Position where) {
  if (!value || type == nullptr || value->type == type) return value;
  if (adapts_to(*value, *type)) return adapted(std::move(value), type);
  if (type->is_reference()) {
    Value target;
    target.type = type;
    value = null_beside(std::move(value), target);
  }
  bool known = false;
  value = convert_derived(std::move(value), type, where, known);
  if (known) return value;
  if (value->type->is_literal()) return convert_literal(std::move(value), type, where);
  if (widens(*value->type, *type)) return convert_exactly(std::move(value), type);
  if (!a_.dialect->bits_calculate || !exchanges_bits(*value->type, *type))
    return mismatch(*value->type, *type, where);
  return convert_exactly(counted(std::move(value)), type);
}

bool ExpressionAnalyzer::adapts_to(const Value& value, const Type& type) {
  if (!value.adapts || type.kind != TypeKind::Elementary) return false;
  return value.kind == ValueKind::Truncate ? type.is_integer() : type.is(ElementaryType::Real);
}

ValuePtr ExpressionAnalyzer::adapted(ValuePtr value, const Type* type) {
  value->adapts = false;
  if (value->kind != ValueKind::Truncate) return convert_exactly(std::move(value), type);
  value->type = type;
  return value;
}

// A function of literals that is no constant: SEL(b, 1, 2). Its operands get the type.
ValuePtr ExpressionAnalyzer::retype(ValuePtr value, const Type* type, Position where) {
  for (ValuePtr& each : value->operands) {
    if (!each->type->is_literal()) continue;
    each = convert(std::move(each), type, where);
    if (!each) return nullptr;
  }
  value->type = type;
  return value;
}

ValuePtr ExpressionAnalyzer::convert_literal(ValuePtr value, const Type* type, Position where) {
  if (type->is_literal() && value->kind != ValueKind::Constant) return retype(std::move(value), type, where);
  if (type->kind == TypeKind::AnyReal)
    return make_constant({0, static_cast<double>(value->constant.integer)}, type, value->where);
  Constant constant = value->constant;
  if (type->is_real()) {
    if (value->kind != ValueKind::Constant) return retype(std::move(value), type, where);
    if (value->type->kind == TypeKind::AnyInteger) constant = {0, static_cast<double>(constant.integer)};
    if (type->is(ElementaryType::Real) && std::isinf(static_cast<float>(constant.real)) &&
        std::isfinite(constant.real)) {
      a_.error(code::kOutOfRange, where, "the number is too large for REAL", "use LREAL");
      return nullptr;
    }
    return make_constant(wrapped(constant, *type), type, value->where);
  }
  const bool takes_numbers = type->is_integer() || type->is_bits() || type->is_bool();
  if (value->type->kind != TypeKind::AnyInteger || type->kind != TypeKind::Elementary || !takes_numbers)
    return mismatch(*value->type, *type, where);
  if (value->kind != ValueKind::Constant) return retype(std::move(value), type, where);
  if (!fits(constant, *type)) {
    if (type->is_bool()) return mismatch(*value->type, *type, where);
    const IntegerRange range = range_of(type->elementary);
    a_.error(code::kOutOfRange, where, to_string(constant.integer) + " is out of the range of " + type->name,
             type->name + " goes from " + to_string(range.low) + " to " + to_string(range.high));
    return nullptr;
  }
  return make_constant(constant, type, value->where);
}

ValuePtr ExpressionAnalyzer::convert_exactly(ValuePtr value, const Type* type) const {
  if (value->type == type) return value;
  if (value->kind == ValueKind::Constant) {
    if (const auto constant = converted(value->constant, *value->type, *type))
      return make_constant(*constant, type, value->where);
  }
  ValuePtr result = make(ValueKind::Convert, type, value->where);
  result->operands.push_back(std::move(value));
  return result;
}

ValuePtr ExpressionAnalyzer::truncated(ValuePtr value, const Type* type, const syntax::Expression& call) {
  value = settle(std::move(value));
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
ValuePtr ExpressionAnalyzer::through_unsigned(ValuePtr value, const Type* to) {
  const std::uint32_t bytes = to->is_bits() ? to->size : value->type->size;
  ValuePtr whole = convert_exactly(std::move(value), whole_type(bytes, false));
  whole = convert_exactly(std::move(whole), to);
  whole->converts_part = true;
  return whole;
}

// An elementary type, or a string of any length; null if the name is none of them.
const Type* ExpressionAnalyzer::named_type(const std::string& folded) const {
  for (const auto which : {ElementaryType::String, ElementaryType::Wstring})
    if (folded == bytecode::name_of(which))
      return a_.type_table().string(which, bytecode::kMaxStringCapacity);
  ElementaryType which{};
  return elementary_from(folded, which) ? a_.type_table().elementary(which) : nullptr;
}

std::optional<NamedConversion> ExpressionAnalyzer::named_conversion(const std::string& folded) const {
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

ValuePtr ExpressionAnalyzer::explicit_conversion(const syntax::Expression& call,
                                                 const NamedConversion& conversion) {
  auto arguments = StandardAnalyzer(a_, *this).arguments(call, "IN", 1);
  if (!arguments) return nullptr;
  ValuePtr value = std::move(arguments->front());
  value = conversion.from != nullptr
              ? convert(std::move(value), conversion.from, call.arguments[0].value->where)
              : settle(std::move(value));
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
ValuePtr ExpressionAnalyzer::bcd_conversion(ValuePtr value, const NamedConversion& conversion,
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
  return StandardAnalyzer(a_, *this).make_standard(
      reads ? StandardFunction::FromBcd : StandardFunction::ToBcd, conversion.to, std::move(operands),
      call.where);
}

}  // namespace stepwright::semantics::internal
