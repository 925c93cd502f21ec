#include "ladder/semantics/constants/constant_conversion.h"

#include <cmath>
#include <vector>

#include "ladder/semantics/constants/constant_function.h"

namespace stepwright::semantics {

namespace {

bool counts_ns(const Type& type) {
  return type.is_time() || type.is(ElementaryType::Date) || type.is(ElementaryType::Tod) ||
         type.is(ElementaryType::Dt);
}

bool is_whole(const Type& type) {
  return type.is_integer() || type.is_bits() || type.is_bool() || type.is(ElementaryType::Char) ||
         type.is(ElementaryType::Wchar);
}

std::optional<Constant> rounded(double value, const Type& to) {
  if (!(std::abs(value) < 1e19)) return std::nullopt;
  const Constant whole{static_cast<__int128>(std::nearbyint(value))};
  return fits(whole, to) ? std::optional(whole) : std::nullopt;
}

std::optional<Constant> from_time(const Constant& value, const Type& from, const Type& to) {
  if (to.is_real()) {
    const double ms = static_cast<double>(static_cast<std::int64_t>(value.integer)) /
                      static_cast<double>(time_unit_ns(from));
    return wrapped({0, ms}, to);
  }
  if (is_whole(to)) return wrapped({value.integer / time_unit_ns(from)}, to);
  const Constant operand[] = {value};
  if (to.is(ElementaryType::Date)) return evaluate(StandardFunction::DayOf, operand, from, to);
  if (to.is(ElementaryType::Tod)) return evaluate(StandardFunction::TimeOfDay, operand, from, to);
  return value;
}

}  // namespace

std::int64_t time_unit_ns(const Type& time_or_date) {
  const bool milliseconds = time_or_date.is_time() || time_or_date.is(ElementaryType::Tod);
  return milliseconds ? 1'000'000 : 1'000'000'000;
}

bool transfers_bits(const Type& from, const Type& to) {
  const bool real = (from.is_real() && to.is_bits()) || (from.is_bits() && to.is_real());
  return real && from.kind == to.kind && from.size == to.size;
}

bool is_narrowed_character(const Type& from, const Type& to) {
  return from.is(ElementaryType::Wchar) && to.is(ElementaryType::Char);
}

std::optional<Constant> converted(const Constant& value, const Type& from, const Type& to) {
  if (counts_ns(from)) return from_time(value, from, to);
  if (counts_ns(to)) {
    const std::int64_t unit = time_unit_ns(to);
    if (from.is_real()) return rounded(value.real * static_cast<double>(unit), to);
    if (!is_whole(from)) return std::nullopt;
    // The machine multiplies 64 bits.
    const auto low = static_cast<std::uint64_t>(value.integer) * static_cast<std::uint64_t>(unit);
    return wrapped({static_cast<__int128>(low)}, to);
  }
  if (transfers_bits(from, to)) {
    std::vector<std::byte> bytes(from.size);
    store(value, from, bytes);
    return load(to, bytes);
  }
  if (is_narrowed_character(from, to)) return value.integer > 0xFF ? Constant{kNoCharacter} : value;
  if (from.is_bits() && to.is_bool()) return Constant{value.integer & 1};
  if (from.is_real() && to.is_real()) return wrapped(value, to);
  if (from.is_real() && to.is_bool()) return Constant{value.real != 0 ? 1 : 0};
  if (from.is_real() && is_whole(to)) return rounded(value.real, to);
  if (!is_whole(from)) return std::nullopt;
  if (to.is_bool()) return Constant{value.integer != 0 ? 1 : 0};
  if (!to.is_real()) return is_whole(to) ? std::optional(wrapped(value, to)) : std::nullopt;
  // Rounded once, as the machine does it.
  const bool single = to.is(ElementaryType::Real);
  return Constant{0, single ? static_cast<double>(static_cast<float>(value.integer))
                            : static_cast<double>(value.integer)};
}

}  // namespace stepwright::semantics
