#include "plant_models/components/library/fmu_units.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace stepwright::components::library {
namespace {

bool alike(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

// As UDUNITS reads it: "0.001 m3 s-1", "(0.5555 K) @ 459.67".
std::string text_of(const fmu::UnitDefinition& definition) {
  constexpr auto& kBases = fmu::UnitDefinition::kBases;
  std::array<char, 40> number{};
  std::string text;
  if (definition.factor != 1.0) {
    std::snprintf(number.data(), number.size(), "%.17g", definition.factor);
    text = number.data();
  }
  for (std::size_t i = 0; i < kBases.size(); ++i) {
    if (definition.exponents[i] == 0) continue;
    text += (text.empty() ? "" : " ") + std::string(kBases[i]);
    if (definition.exponents[i] != 1) text += std::to_string(definition.exponents[i]);
  }
  if (definition.offset == 0.0) return text;
  std::snprintf(number.data(), number.size(), "%.17g", definition.offset / definition.factor);
  return "(" + (text.empty() ? "1" : text) + ") @ " + number.data();
}

}  // namespace

bool same_measure(const Unit& a, const Unit& b) {
  return a.dimension == b.dimension && alike(a.factor, b.factor) && alike(a.offset, b.offset);
}

std::optional<Unit> unit_of(const fmu::ModelDescription& description, const fmu::ModelVariable& variable) {
  const std::optional<Unit> named = parse_unit(variable.unit);
  const fmu::UnitDefinition* const definition = description.find_unit(variable.unit);
  if (definition == nullptr) return named;
  if (definition->other || !std::isfinite(definition->factor) || definition->factor == 0.0)
    return std::nullopt;
  const std::optional<Unit> defined = parse_unit(text_of(*definition));
  return named && defined && same_measure(*named, *defined) ? named : defined;
}

}  // namespace stepwright::components::library
