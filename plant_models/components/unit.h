#pragma once

// Units of measurement as people write them ("6000 m/(m3/s)", "55 percent", "20 degC"), by UDUNITS-2. A unit
// says how a figure becomes SI and which dimension it has.
//
// Thread-safe; the catalogue of units is read at the first call.
// Invariant: two units of the same dimension can stand for each other.
//
//   const auto unit = parse_unit("l/min");       // factor 1.6667e-5, m3 s-1
//   const auto figure = parse_quantity("3 l");   // 0.003, m3

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace stepwright::components {

// Exponents of m, kg, s, K, A. Angles, shares and counts have none.
struct Dimension {
  std::array<std::int8_t, 5> exponents{};

  bool none() const { return *this == Dimension{}; }
  friend bool operator==(const Dimension&, const Dimension&) = default;
};

struct Unit {
  std::string text;     // as it was written
  double factor = 1.0;  // SI = factor * figure + offset
  double offset = 0.0;  // of temperatures
  Dimension dimension;

  double to_si(double figure) const { return factor * figure + offset; }
  double from_si(double value) const { return (value - offset) / factor; }
};

struct Quantity {
  double value = 0.0;  // SI
  Unit unit;
};

// Nothing if nobody knows the unit. An empty text is the unit of pure numbers.
std::optional<Unit> parse_unit(std::string_view text);

// A figure with its unit behind it, or a pure number; nothing if it is neither.
std::optional<Quantity> parse_quantity(std::string_view text);

// What people write for a unit that UDUNITS-2 calls otherwise, of a figure or a unit: "gpm is
// \"gallon/min\"". Empty: nothing of the kind.
std::string unit_hint(std::string_view text);

// "m3 s-1"; "a pure number" without a dimension.
std::string to_string(const Dimension& dimension);

}  // namespace stepwright::components
