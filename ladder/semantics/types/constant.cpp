#include "ladder/semantics/types/constant.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "ladder/semantics/types/operator_group.h"

namespace stepwright::semantics {

namespace {

using syntax::Operator;

__int128 truth(bool value) {
  return value ? 1 : 0;
}

template <typename T>
std::optional<Constant> compare(Operator op, T left, T right) {
  switch (op) {
    case Operator::Equal:
      return Constant{truth(left == right)};
    case Operator::NotEqual:
      return Constant{truth(left != right)};
    case Operator::Less:
      return Constant{truth(left < right)};
    case Operator::LessEqual:
      return Constant{truth(left <= right)};
    case Operator::Greater:
      return Constant{truth(left > right)};
    case Operator::GreaterEqual:
      return Constant{truth(left >= right)};
    default:
      return std::nullopt;
  }
}

std::optional<__int128> integers(Operator op, __int128 left, __int128 right) {
  switch (op) {
    case Operator::Add:
      return left + right;
    case Operator::Subtract:
      return left - right;
    case Operator::Multiply:
      return left * right;
    case Operator::Divide:
      return right == 0 ? std::nullopt : std::optional(left / right);
    case Operator::Modulo:
      return right == 0 ? std::nullopt : std::optional(left % right);
    case Operator::And:
    case Operator::AndThen:
      return left & right;
    case Operator::Or:
    case Operator::OrElse:
      return left | right;
    case Operator::Xor:
      return left ^ right;
    default:
      return std::nullopt;
  }
}

template <typename T>
std::optional<T> reals(Operator op, T left, T right) {
  switch (op) {
    case Operator::Add:
      return left + right;
    case Operator::Subtract:
      return left - right;
    case Operator::Multiply:
      return left * right;
    case Operator::Divide:
      // The machine stops here, in every type.
      return right == 0 ? std::nullopt : std::optional(left / right);
    default:
      return std::nullopt;
  }
}

}  // namespace

bool fits(const Constant& value, const Type& type) {
  if (type.kind == TypeKind::AnyInteger) return true;
  const IntegerRange range = range_of(type.elementary);
  return value.integer >= range.low && value.integer <= range.high;
}

Constant wrapped(Constant value, const Type& type) {
  if (type.is(ElementaryType::Real)) value.real = static_cast<float>(value.real);
  if (type.is_real() || type.is_literal()) return value;
  if (type.is_bool()) return {value.integer & 1};
  const unsigned bits = type.bit_count();
  const __int128 modulus = static_cast<__int128>(1) << bits;
  __int128 rest = value.integer & (modulus - 1);
  if (!type.is_unsigned() && rest >= modulus / 2) rest -= modulus;
  return {rest};
}

std::optional<Constant> evaluate(Operator op, const Constant& left, const Constant& right,
                                 const Type& operands) {
  if (operands.is_real()) {
    if (is_comparison(op)) return compare(op, left.real, right.real);
    std::optional<double> value;
    if (operands.is(ElementaryType::Real)) {
      value = reals(op, static_cast<float>(left.real), static_cast<float>(right.real));
    } else {
      value = reals(op, left.real, right.real);
    }
    return value ? std::optional(Constant{0, *value}) : std::nullopt;
  }
  if (is_comparison(op)) return compare(op, left.integer, right.integer);
  const auto value = integers(op, left.integer, right.integer);
  return value ? std::optional(wrapped({*value}, operands)) : std::nullopt;
}

namespace {

void store_text(const std::u16string& text, const Type& type, std::span<std::byte> out) {
  const std::size_t width = bytecode::character_bytes(type.elementary);
  const auto length = static_cast<std::uint16_t>(text.size());
  std::memcpy(out.data() + 2, &length, sizeof(length));
  const auto characters = out.subspan(bytecode::kStringHeaderBytes);
  std::ranges::fill(characters, std::byte{0});
  for (std::size_t i = 0; i < text.size(); ++i) std::memcpy(characters.data() + i * width, &text[i], width);
}

Constant load_text(const Type& type, std::span<const std::byte> bytes) {
  const std::size_t width = bytecode::character_bytes(type.elementary);
  std::uint16_t length = 0;
  std::memcpy(&length, bytes.data() + 2, sizeof(length));
  Constant value;
  value.text.resize(length);
  for (std::size_t i = 0; i < length; ++i)
    std::memcpy(&value.text[i], bytes.data() + bytecode::kStringHeaderBytes + i * width, width);
  return value;
}

}  // namespace

void store(const Constant& value, const Type& type, std::span<std::byte> out) {
  if (type.is_string()) return store_text(value.text, type, out);
  if (type.is(ElementaryType::Real)) {
    const auto single = static_cast<float>(value.real);
    std::memcpy(out.data(), &single, sizeof(single));
  } else if (type.is(ElementaryType::Lreal)) {
    std::memcpy(out.data(), &value.real, sizeof(value.real));
  } else {
    const auto low = static_cast<std::uint64_t>(value.integer);
    std::memcpy(out.data(), &low, std::min(out.size(), sizeof(low)));
  }
}

Constant load(const Type& type, std::span<const std::byte> bytes) {
  if (type.is_string()) return load_text(type, bytes);
  if (type.is(ElementaryType::Real)) {
    float single = 0;
    std::memcpy(&single, bytes.data(), sizeof(single));
    return {0, single};
  }
  if (type.is(ElementaryType::Lreal)) {
    Constant value;
    std::memcpy(&value.real, bytes.data(), sizeof(value.real));
    return value;
  }
  std::uint64_t low = 0;
  std::memcpy(&low, bytes.data(), std::min(bytes.size(), sizeof(low)));
  return wrapped({static_cast<__int128>(low)}, type);
}

std::string to_string(__int128 value) {
  if (value == 0) return "0";
  std::string digits;
  const bool negative = value < 0;
  while (value != 0) {
    const int digit = static_cast<int>(value % 10);
    digits += static_cast<char>('0' + (digit < 0 ? -digit : digit));
    value /= 10;
  }
  if (negative) digits += '-';
  std::reverse(digits.begin(), digits.end());
  return digits;
}

}  // namespace stepwright::semantics
