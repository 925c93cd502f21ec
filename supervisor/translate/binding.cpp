#include "supervisor/translate/binding.h"

#include <algorithm>
#include <utility>

namespace stepwright::translate {

namespace {

template <typename Items, typename Test>
auto* find_in(const Items& items, Test test) {
  const auto found = std::find_if(items.begin(), items.end(), test);
  return found == items.end() ? nullptr : &*found;
}

}  // namespace

const Tag* Binding::tag(std::string_view name) const {
  return find_in(tags, [name](const Tag& t) { return t.name == name; });
}

const Sensor* Binding::sensor_of(std::string_view fluent) const {
  return find_in(sensors, [fluent](const Sensor& s) { return s.fluent == fluent; });
}

const ObservedFact* Binding::observed(std::string_view fact) const {
  return find_in(facts, [fact](const ObservedFact& f) { return f.fact == fact; });
}

const ActionBinding* Binding::action_for(const model::GroundAction& action, Assignment& assignment) const {
  for (const ActionBinding& entry : actions) {
    if (auto bound = match(entry.pattern, action)) {
      assignment = std::move(*bound);
      return &entry;
    }
  }
  return nullptr;
}

std::vector<std::string> Binding::devices_of(const model::GroundAction& action) const {
  Assignment assignment;
  const ActionBinding* entry = action_for(action, assignment);
  const std::vector<std::string> driven = entry == nullptr ? std::vector<std::string>{} : entry->outputs;
  const auto drives = [&driven](const std::string& output) {
    return std::find(driven.begin(), driven.end(), output) != driven.end();
  };
  std::vector<std::string> names;
  for (const Device& device : devices) {
    const bool needed =
        std::any_of(device.actions.begin(), device.actions.end(),
                    [&action](const Pattern& pattern) { return match(pattern, action).has_value(); });
    if (needed || std::any_of(device.outputs.begin(), device.outputs.end(), drives))
      names.push_back(device.name);
  }
  for (const std::string& output : driven) {
    const bool named = std::any_of(devices.begin(), devices.end(), [&output](const Device& device) {
      return std::find(device.outputs.begin(), device.outputs.end(), output) != device.outputs.end();
    });
    if (!named) names.push_back(output);
  }
  return names;
}

std::string search_step(std::size_t group, std::size_t search) {
  return "SEARCH_" + std::to_string(group + 1) + "_" + std::to_string(search + 1);
}

std::string filtered_variable(const Sensor& sensor) {
  return sensor.name + "_filtered";
}

std::string half_variable(const Sensor& sensor) {
  return sensor.name + "_half";
}

}  // namespace stepwright::translate
