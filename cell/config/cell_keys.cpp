#include "cell/config/cell_keys.h"

#include <vector>

#include "cell/missions/table/mission_tables.h"

namespace stepwright::config {

std::span<const settings::KeyWords> cell_keys() {
  static const std::vector<settings::KeyWords> all = [] {
    std::vector<settings::KeyWords> keys;
    for (const auto& part : {process_keys(), safety_keys(), plant_keys(), modbus_keys()})
      keys.insert(keys.end(), part.begin(), part.end());
    const std::vector<settings::KeyWords> missions = missions::mission_keys();
    keys.insert(keys.end(), missions.begin(), missions.end());
    return keys;
  }();
  return all;
}

}  // namespace stepwright::config
