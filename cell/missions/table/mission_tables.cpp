#include "cell/missions/table/mission_tables.h"

namespace stepwright::missions {

// Each planner's own (cell/missions/NAME/table).
#define STEPWRIGHT_MISSION(name)                                                            \
  std::shared_ptr<const MissionTable> read_##name##_table(const settings::TomlTable& table, \
                                                          const TablePlace& place);         \
  std::span<const settings::KeyWords> name##_keys();
#include "cell/missions/missions.def"
#undef STEPWRIGHT_MISSION

namespace {

struct NamedReader {
  const char* name;
  TableReader read;
  std::span<const settings::KeyWords> (*keys)();
};

constexpr NamedReader kReaders[] = {
#define STEPWRIGHT_MISSION(name) {#name, read_##name##_table, name##_keys},
#include "cell/missions/missions.def"
#undef STEPWRIGHT_MISSION
};

}  // namespace

CellMission read_mission(const settings::TomlTable& root, const TablePlace& place) {
  CellMission mission;
  for (const NamedReader& reader : kReaders) {
    if (!root.has(reader.name)) continue;
    auto table = reader.read(root.table(reader.name), place);
    if (mission.table) {
      root.report(reader.name, "the cell has [" + mission.name + "] and [" + reader.name + "]",
                  "a cell has one mission: leave one of them out", "0545");
      continue;
    }
    mission = {reader.name, std::move(table)};
  }
  return mission;
}

std::vector<settings::KeyWords> mission_keys() {
  std::vector<settings::KeyWords> all;
  for (const NamedReader& reader : kReaders) {
    const std::span<const settings::KeyWords> keys = reader.keys();
    all.insert(all.end(), keys.begin(), keys.end());
  }
  return all;
}

std::string mission_tables() {
  std::string names;
  for (const NamedReader& reader : kReaders)
    names += (names.empty() ? "[" : ", [") + std::string(reader.name) + "]";
  return names;
}

}  // namespace stepwright::missions
