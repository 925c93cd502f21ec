#include "plant_models/components/unit.h"

#include <udunits2.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>

namespace stepwright::components {
namespace {

constexpr std::array<const char*, 5> kBase = {"m", "kg", "s", "K", "A"};

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using UnitPointer = std::unique_ptr<ut_unit, FreeUnit>;

// The catalogue of units; null if its file is missing.
ut_system* catalogue() {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);
    return ut_read_xml(nullptr);
  }();
  return system;
}

// What the visitor of UDUNITS finds in a unit.
struct Found {
  Dimension dimension;
  bool other = false;  // a unit that no component speaks of (mol, cd), or a logarithm

  ut_status add(const ut_unit* unit, int power) {
    const char* symbol = ut_get_symbol(unit, UT_UTF8);
    if (symbol == nullptr) symbol = ut_get_name(unit, UT_UTF8);
    if (symbol != nullptr && std::strcmp(symbol, "rad") == 0) return UT_SUCCESS;
    for (std::size_t i = 0; i < kBase.size(); ++i) {
      if (symbol == nullptr || std::strcmp(symbol, kBase[i]) != 0) continue;
      dimension.exponents[i] = static_cast<std::int8_t>(dimension.exponents[i] + power);
      return UT_SUCCESS;
    }
    other = true;
    return UT_SUCCESS;
  }
};

ut_status visit_basic(const ut_unit* unit, void* found) {
  return static_cast<Found*>(found)->add(unit, 1);
}
ut_status visit_product(const ut_unit*, int count, const ut_unit* const* units, const int* powers,
                        void* found) {
  for (int i = 0; i < count; ++i) static_cast<Found*>(found)->add(units[i], powers[i]);
  return UT_SUCCESS;
}
ut_status visit_scaled(const ut_unit*, double, const ut_unit* below, double, void* found);
ut_status visit_time(const ut_unit*, const ut_unit*, double, void* found) {
  static_cast<Found*>(found)->other = true;
  return UT_SUCCESS;
}
ut_status visit_logarithm(const ut_unit*, double, const ut_unit*, void* found) {
  static_cast<Found*>(found)->other = true;
  return UT_SUCCESS;
}
const ut_visitor kVisitor = {visit_basic, visit_product, visit_scaled, visit_time, visit_logarithm};
ut_status visit_scaled(const ut_unit*, double, const ut_unit* below, double, void* found) {
  return ut_accept_visitor(below, &kVisitor, found);
}

// Powers of ten come out of UDUNITS with a last bit too many.
double rounded(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.15g", value);
  return std::strtod(text.data(), nullptr);
}

UnitPointer si_unit(const Dimension& dimension) {
  UnitPointer product(ut_get_dimensionless_unit_one(catalogue()));
  for (std::size_t i = 0; product != nullptr && i < kBase.size(); ++i) {
    const UnitPointer base(ut_get_unit_by_symbol(catalogue(), kBase[i]));
    const UnitPointer power(ut_raise(base.get(), dimension.exponents[i]));
    product.reset(ut_multiply(product.get(), power.get()));
  }
  return product;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

}  // namespace

namespace {

std::optional<Unit> parse_new_unit(std::string_view text) {
  Unit unit;
  unit.text = std::string(trimmed(text));
  if (unit.text.empty()) return unit;
  if (catalogue() == nullptr) return std::nullopt;
  const UnitPointer parsed(ut_parse(catalogue(), unit.text.c_str(), UT_UTF8));
  if (parsed == nullptr) return std::nullopt;
  Found found;
  if (ut_accept_visitor(parsed.get(), &kVisitor, &found) != UT_SUCCESS || found.other) return std::nullopt;
  unit.dimension = found.dimension;
  const UnitPointer si = si_unit(unit.dimension);
  if (si == nullptr || ut_are_convertible(parsed.get(), si.get()) == 0) return std::nullopt;
  cv_converter* const converter = ut_get_converter(parsed.get(), si.get());
  if (converter == nullptr) return std::nullopt;
  unit.offset = rounded(cv_convert_double(converter, 0.0));
  unit.factor = rounded((cv_convert_double(converter, 1024.0) - unit.offset) / 1024.0);
  cv_free(converter);
  return unit;
}

}  // namespace

// A plant has thousands of figures and few units.
std::optional<Unit> parse_unit(std::string_view text) {
  static std::mutex mutex;  // of all that UDUNITS has: it knows no threads
  static std::map<std::string, std::optional<Unit>, std::less<>> known;
  const std::lock_guard lock(mutex);
  const auto found = known.find(text);
  if (found != known.end()) return found->second;
  return known.emplace(std::string(text), parse_new_unit(text)).first->second;
}

std::optional<Quantity> parse_quantity(std::string_view text) {
  text = trimmed(text);
  double figure = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), figure);
  if (error != std::errc() || !std::isfinite(figure)) return std::nullopt;
  auto unit = parse_unit(text.substr(static_cast<std::size_t>(end - text.data())));
  if (!unit) return std::nullopt;
  const double value = unit->to_si(figure);
  return Quantity{value, std::move(*unit)};
}

std::string unit_hint(std::string_view text) {
  struct Usual {
    std::string_view written;
    std::string_view known;
  };
  constexpr std::array<Usual, 12> kUsual = {{{"gpm", "gallon/min"},
                                             {"gph", "gallon/hour"},
                                             {"gal", "gallon"},
                                             {"gal/min", "gallon/min"},
                                             {"lpm", "l/min"},
                                             {"cfm", "ft3/min"},
                                             {"barg", "bar"},
                                             {"bara", "bar"},
                                             {"psig", "psi"},
                                             {"psia", "psi"},
                                             {"cc", "cm3"},
                                             {"ccm", "cm3"}}};
  text = trimmed(text);
  while (!text.empty() && (text.front() < 'A')) text.remove_prefix(1);  // the figure
  const auto found =
      std::find_if(kUsual.begin(), kUsual.end(), [&](const Usual& each) { return each.written == text; });
  if (found == kUsual.end()) return {};
  return std::string(text) +
         (text.starts_with("gal") ? " is an acceleration, 1 cm/s2; meant is \"" : " is \"") +
         std::string(found->known) + "\"";
}

std::string to_string(const Dimension& dimension) {
  std::string text;
  for (std::size_t i = 0; i < kBase.size(); ++i) {
    if (dimension.exponents[i] == 0) continue;
    text += (text.empty() ? "" : " ") + std::string(kBase[i]);
    if (dimension.exponents[i] != 1) text += std::to_string(dimension.exponents[i]);
  }
  return text.empty() ? "a pure number" : text;
}

}  // namespace stepwright::components
