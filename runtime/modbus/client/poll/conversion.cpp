#include "runtime/modbus/client/poll/conversion.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace stepwright::modbus::client {
namespace {

// A value between wire and image. Whole numbers are kept as their sign and 64 bits.
struct Number {
  enum class Kind : std::uint8_t { Signed, Unsigned, Real };
  Kind kind = Kind::Unsigned;
  std::uint64_t bits = 0;  // of the whole number
  double real = 0.0;

  static Number of(std::int64_t value) { return {Kind::Signed, static_cast<std::uint64_t>(value), 0.0}; }
  static Number of(std::uint64_t value) { return {Kind::Unsigned, value, 0.0}; }
  static Number of(double value) { return {Kind::Real, 0, value}; }

  double as_double() const {
    if (kind == Kind::Real) return real;
    return kind == Kind::Signed ? static_cast<double>(static_cast<std::int64_t>(bits))
                                : static_cast<double>(bits);
  }
  bool negative() const { return kind == Kind::Signed && static_cast<std::int64_t>(bits) < 0; }
};

// A whole-number type by its width and sign.
struct Whole {
  std::uint32_t bits;
  bool is_signed;

  std::uint64_t largest() const { return ~std::uint64_t{0} >> (64 - bits + (is_signed ? 1 : 0)); }
  std::uint64_t mask() const { return ~std::uint64_t{0} >> (64 - bits); }
  std::uint64_t smallest() const { return is_signed ? (std::uint64_t{1} << (bits - 1)) : 0; }
};

struct Held {
  std::uint64_t bits = 0;
  bool exceeded = false;
};

Held hold(const Number& number, const Whole& type) {
  if (number.kind == Number::Kind::Real) {
    const double rounded = std::nearbyint(number.real);
    // 2^63 and 2^64 are doubles, the largest values below them are not.
    const double end = std::ldexp(1.0, static_cast<int>(type.bits) - (type.is_signed ? 1 : 0));
    const double begin = type.is_signed ? -end : 0.0;
    if (rounded >= end) return {type.largest(), true};
    if (rounded < begin) return {type.smallest(), true};
    const std::uint64_t bits = type.is_signed ? static_cast<std::uint64_t>(static_cast<std::int64_t>(rounded))
                                              : static_cast<std::uint64_t>(rounded);
    return {bits & type.mask(), false};
  }
  if (number.negative()) {
    const auto value = static_cast<std::int64_t>(number.bits);
    if (!type.is_signed) return {0, true};
    const std::int64_t begin =
        type.bits == 64 ? std::numeric_limits<std::int64_t>::min() : -(std::int64_t{1} << (type.bits - 1));
    return value < begin ? Held{type.smallest(), true} : Held{number.bits & type.mask(), false};
  }
  return number.bits > type.largest() ? Held{type.largest(), true} : Held{number.bits, false};
}

Held hold_real(double value) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  const bool exceeded = std::isfinite(value) && std::abs(value) > kLargest;
  const auto narrow = static_cast<float>(exceeded ? std::copysign(kLargest, value) : value);
  return {std::bit_cast<std::uint32_t>(narrow), exceeded};
}

Whole whole_of(ImageType type) {
  const bool is_signed =
      type == ImageType::Sint || type == ImageType::Int || type == ImageType::Dint || type == ImageType::Lint;
  return {type == ImageType::Bool ? 1 : bytes_of(type) * 8, is_signed};
}

Held hold_image(ImageType type, const Number& number) {
  if (type == ImageType::Real) return hold_real(number.as_double());
  if (type == ImageType::Lreal) return {std::bit_cast<std::uint64_t>(number.as_double()), false};
  return hold(number, whole_of(type));
}

Number image_number(ImageType type, std::uint64_t bits) {
  switch (type) {
    case ImageType::Sint:
      return Number::of(std::int64_t{static_cast<std::int8_t>(bits)});
    case ImageType::Int:
      return Number::of(std::int64_t{static_cast<std::int16_t>(bits)});
    case ImageType::Dint:
      return Number::of(std::int64_t{static_cast<std::int32_t>(bits)});
    case ImageType::Lint:
      return Number::of(static_cast<std::int64_t>(bits));
    case ImageType::Real:
      return Number::of(double{std::bit_cast<float>(static_cast<std::uint32_t>(bits))});
    case ImageType::Lreal:
      return Number::of(std::bit_cast<double>(bits));
    default:
      return Number::of(bits & whole_of(type).mask());
  }
}

Number wire_number(WireType type, std::uint64_t bits) {
  switch (type) {
    case WireType::Int16:
      return Number::of(std::int64_t{static_cast<std::int16_t>(bits)});
    case WireType::Int32:
      return Number::of(std::int64_t{static_cast<std::int32_t>(bits)});
    case WireType::Int64:
      return Number::of(static_cast<std::int64_t>(bits));
    case WireType::Real:
      return Number::of(double{std::bit_cast<float>(static_cast<std::uint32_t>(bits))});
    case WireType::Lreal:
      return Number::of(std::bit_cast<double>(bits));
    default:
      return Number::of(bits);
  }
}

Held hold_wire(WireType type, const Number& number) {
  switch (type) {
    case WireType::Bool:
      return {number.as_double() != 0.0 ? 1u : 0u, false};
    case WireType::Real:
      return hold_real(number.as_double());
    case WireType::Lreal:
      return {std::bit_cast<std::uint64_t>(number.as_double()), false};
    default: {
      const bool is_signed = type == WireType::Int16 || type == WireType::Int32 || type == WireType::Int64;
      return hold(number, {registers_of(type) * 16u, is_signed});
    }
  }
}

std::uint16_t in_order(std::uint16_t word, Order order) {
  const bool exchanged = order == Order::Badc || order == Order::Dcba;
  return exchanged ? static_cast<std::uint16_t>(word << 8 | word >> 8) : word;
}

bool least_first(Order order) {
  return order == Order::Cdab || order == Order::Dcba;
}

struct Limited {
  double value;
  bool exceeded;
};

Limited limit(const Scale& scale, double value) {
  if (scale.low && value < *scale.low) return {*scale.low, true};
  if (scale.high && value > *scale.high) return {*scale.high, true};
  return {value, false};
}

}  // namespace

ImageValue to_image(const Tag& tag, std::span<const std::uint16_t> words) {
  if (is_bits(tag.table)) return {words[0] != 0 ? 1u : 0u, false, false};
  if (tag.bit != Tag::kWholeRegister)
    return {std::uint64_t{in_order(words[0], tag.order)} >> tag.bit & 1u, false, false};
  const std::size_t count = tag.count();
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = least_first(tag.order) ? count - 1 - i : i;
    bits = bits << 16 | in_order(words[at], tag.order);
  }
  const Number raw = wire_number(tag.wire, bits);
  if (tag.scale.plain() && raw.kind != Number::Kind::Real) {
    const Held held = hold_image(tag.field.type, raw);
    return {held.bits, held.exceeded, false};
  }
  const double value = raw.as_double() * tag.scale.factor + tag.scale.offset;
  if (std::isnan(value)) return {0, false, true};
  const Limited limited = limit(tag.scale, value);
  const Held held = hold_image(tag.field.type, Number::of(limited.value));
  return {held.bits, limited.exceeded || held.exceeded, false};
}

WireValue to_wire(const Tag& tag, std::uint64_t image_bits) {
  WireValue wire;
  Number number = image_number(tag.field.type, image_bits);
  if (is_bits(tag.table) || tag.bit != Tag::kWholeRegister) {
    wire.words[0] = number.as_double() != 0.0 ? 1 : 0;
    return wire;
  }
  if (!tag.scale.plain()) {
    const Limited limited = limit(tag.scale, number.as_double());
    wire.exceeded = limited.exceeded;
    number = Number::of((limited.value - tag.scale.offset) / tag.scale.factor);
  }
  const bool whole = tag.wire != WireType::Real && tag.wire != WireType::Lreal;
  if (whole && std::isnan(number.as_double())) {
    number = Number::of(std::uint64_t{0});
    wire.exceeded = true;
  }
  const Held held = hold_wire(tag.wire, number);
  wire.exceeded = wire.exceeded || held.exceeded;
  const std::size_t count = tag.count();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = least_first(tag.order) ? i : count - 1 - i;
    wire.words[at] = in_order(static_cast<std::uint16_t>(held.bits >> 16 * i), tag.order);
  }
  return wire;
}

std::uint64_t image_bits_of(ImageType type, double value) {
  return hold_image(type, Number::of(value)).bits;
}

double number_of(ImageType type, std::uint64_t bits) {
  return image_number(type, bits).as_double();
}

std::uint64_t get_field(std::span<const std::byte> area, const ImageField& field) {
  if (field.type == ImageType::Bool)
    return std::to_integer<std::uint64_t>(area[field.byte]) >> field.bit & 1u;
  std::uint64_t bits = 0;
  for (std::uint32_t i = 0; i < bytes_of(field.type); ++i)
    bits |= std::to_integer<std::uint64_t>(area[field.byte + i]) << 8 * i;
  return bits;
}

void put_field(std::span<std::byte> area, const ImageField& field, std::uint64_t bits) {
  if (field.type == ImageType::Bool) {
    const std::byte mask = std::byte{1} << field.bit;
    area[field.byte] = bits != 0 ? area[field.byte] | mask : area[field.byte] & ~mask;
    return;
  }
  for (std::uint32_t i = 0; i < bytes_of(field.type); ++i)
    area[field.byte + i] = static_cast<std::byte>(bits >> 8 * i);
}

}  // namespace stepwright::modbus::client
