#include "plant_models/components/describe.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "plant_models/core/names.h"

namespace stepwright::components {
namespace {

struct OutputPlace {
  std::uint32_t component = 0;
  std::size_t port = 0;
};

// The output whose value stands there.
std::optional<OutputPlace> output_at(const Model& model, std::uint32_t slot) {
  for (std::uint32_t c = 0; c < model.components.size(); ++c) {
    const auto& specs = model.types[c]->ports;
    for (std::size_t i = 0; i < specs.size(); ++i)
      if (specs[i].kind == PortKind::Signal && specs[i].role == Role::Node &&
          model.components[c]->ports()[i].across == slot)
        return OutputPlace{c, i};
  }
  return std::nullopt;
}

// What a card reads, or what the sensor before it reads: the quantity without the sensor's errors.
std::optional<OutputPlace> measured_by(const Model& model, std::uint32_t card) {
  auto place = output_at(model, model.components[card]->ports()[0].across);
  if (!place) return std::nullopt;
  const ComponentType& type = *model.types[place->component];
  const bool of_signal = type.name.ends_with("_sensor") && type.ports[0].kind == PortKind::Signal;
  return of_signal ? output_at(model, model.components[place->component]->ports()[0].across) : place;
}

// A terminal behind a card: counts = counts_low + (x - low) (counts_high - counts_low) / (high - low) with x
// in SI, and x = shown * factor + offset.
std::optional<core::SensorDescription> describe_sensor(const Model& model, std::size_t terminal) {
  const auto card = output_at(model, model.sensor_at[terminal].slot);
  if (!card || model.types[card->component]->name != "analog_input") return std::nullopt;
  const auto measured = measured_by(model, card->component);
  if (!measured) return std::nullopt;
  const std::string truth =
      model.names[measured->component] + "." + model.types[measured->component]->ports[measured->port].name;
  const auto index = core::index_of(model.truths, truth);
  if (!index) return std::nullopt;
  const Parameters& figures = model.text.components[card->component].parameters;
  const ModelTruth& shown = model.truth_at[*index];
  const double slope = (figures["counts_high"] - figures["counts_low"]) / (figures["high"] - figures["low"]);
  return core::SensorDescription{model.sensors[terminal].name, model.truths[*index].unit, truth,
                                 figures["counts_low"] + (shown.offset - figures["low"]) * slope,
                                 shown.factor * slope};
}

}  // namespace

core::PlantDescription describe(const Model& model) {
  core::PlantDescription description;
  description.name = model.text.name;
  for (std::size_t i = 0; i < model.sensors.size(); ++i)
    if (auto sensor = describe_sensor(model, i)) description.sensors.push_back(std::move(*sensor));
  return description;
}

}  // namespace stepwright::components
