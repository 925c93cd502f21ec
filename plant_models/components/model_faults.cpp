// Faults of a described plant.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "plant_models/components/component_reader.h"
#include "plant_models/components/model_plant.h"
#include "plant_models/core/names.h"

namespace stepwright::components {
namespace {

std::string number_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

result::Result<std::size_t> find_fault(const Model& model, std::string_view name) {
  if (const auto fault = core::index_of(model.faults, name)) return *fault;
  return result::fail("C0311", {}, "the plant has no fault named '" + std::string(name) + "'",
                      fault_hint(model, std::string(name)));
}

}  // namespace

std::string fault_hint(const Model& model, const std::string& name) {
  const std::size_t dot = name.rfind('.');
  for (const ComponentText& part : model.text.components) {
    if (dot == std::string::npos || part.name != name.substr(0, dot)) continue;
    for (const FaultSpec& fault : part.type->faults) {
      if (fault.name != name.substr(dot + 1) || part.parameters.has(fault.needs)) continue;
      return fault.needs.parameter + " = \"" + fault.needs.choice + "\" in [components." + part.name +
             "] gives it";
    }
  }
  return meant_or(name, core::names_of(model.faults));
}

core::FaultRange ModelPlant::fault_range(std::size_t fault) const {
  const ModelFault& at = model_->fault_at[fault];
  return {std::max(at.low, -at.usual), std::min(at.high, at.usual), at.whole};
}

std::string ModelPlant::violation() const {
  constexpr double kOfAll = 1e-6;
  const double lost = liquid_at_start_ - all_liquid();
  if (std::abs(lost) <= kOfAll * std::max(std::abs(liquid_at_start_), 1e-3)) return {};
  return number_text(std::abs(lost) * 1e3) + " l of liquid " +
         (lost > 0.0 ? "went to nowhere" : "came from nowhere");
}

result::Result<void> ModelPlant::inject_fault(std::string_view name, double value) {
  const auto fault = find_fault(*model_, name);
  if (!fault) return tl::unexpected(fault.error());
  const ModelFault& at = model_->fault_at[*fault];
  if (!(value >= at.low && value <= at.high)) {
    const core::Quantity& quantity = model_->faults[*fault];
    return result::fail("C0312", {},
                        "fault '" + quantity.name + "' cannot have the value " + number_text(value),
                        "allowed: " + number_text(at.low) + " to " + number_text(at.high) +
                            (quantity.unit.empty() ? "" : " ") + quantity.unit +
                            (quantity.meaning.empty() ? "" : "; ") + quantity.meaning);
  }
  set_fault(*fault, value * at.factor);
  return {};
}

result::Result<void> ModelPlant::clear_fault(std::string_view name) {
  const auto fault = find_fault(*model_, name);
  if (!fault) return tl::unexpected(fault.error());
  set_fault(*fault, model_->fault_at[*fault].rest);
  return {};
}

void ModelPlant::set_fault(std::size_t fault, double si) {
  const ModelFault& at = model_->fault_at[fault];
  Component& component = *model_->components[at.component];
  remember();
  // Sampled, so that what a sensor shows now can be kept.
  component.fault_changed(at.fault, si, sampled_frame());
  component.set_fault(at.fault, si);
  sampled_now_ = Sampled::Nothing;
  changed_ = held_changed_ = true;
}

}  // namespace stepwright::components
