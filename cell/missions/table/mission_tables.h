#pragma once

// The table of whichever planner a cell's file names, by the list of planners
// (cell/missions/missions.def).
//
//   const CellMission mission = read_mission(document.root(), {folder});
//   if (mission.table) std::puts(mission.name.c_str());   // "fleet"

#include <memory>
#include <string>
#include <vector>

#include "cell/missions/table/mission_table.h"
#include "runtime/ground/settings/key_words.h"

namespace stepwright::missions {

struct CellMission {
  std::string name{};                           // of the table; empty: the file has none
  std::shared_ptr<const MissionTable> table{};  // null then; never changes, whoever has it
};

// A cell has one mission: C0545 at every table beyond the first.
CellMission read_mission(const settings::TomlTable& root, const TablePlace& place);

// What people are told of the keys of all these tables.
std::vector<settings::KeyWords> mission_keys();

// "[fleet], [planning]"
std::string mission_tables();

}  // namespace stepwright::missions
