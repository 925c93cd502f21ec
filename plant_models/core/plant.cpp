#include "plant_models/core/plant.h"

#include "plant_models/core/names.h"

namespace stepwright::core {
namespace {

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

template <typename Id, typename List>
std::optional<Id> find_id(const List& list, std::string_view name) {
  const auto index = index_of(list, name);
  if (!index) return std::nullopt;
  return Id(*index);
}

}  // namespace

bool same_name(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (lower(a[i]) != lower(b[i])) return false;
  }
  return true;
}

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
