#include "plant_models/core/plant.h"

#include "plant_models/core/names.h"

namespace stepwright::core {
namespace {

template <typename Id, typename List>
std::optional<Id> find_id(const List& list, std::string_view name) {
  const auto index = index_of(list, name);
  if (!index) return std::nullopt;
  return Id(*index);
}

}  // namespace

std::optional<ActuatorId> find_actuator(const Plant& plant, std::string_view name) {
  return find_id<ActuatorId>(plant.actuators(), name);
}

std::optional<SensorId> find_sensor(const Plant& plant, std::string_view name) {
  return find_id<SensorId>(plant.sensors(), name);
}

std::optional<TruthId> find_truth(const Plant& plant, std::string_view name) {
  return find_id<TruthId>(plant.truths(), name);
}

}  // namespace stepwright::core
