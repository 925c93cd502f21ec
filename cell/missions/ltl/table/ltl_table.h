#pragma once

// [ltl]: what a tugger train is to do.
//
//   [ltl]
//   problem = "hall.json"        # floor, train, start and task (supervisor/doc/ltl.md, The planner)
//   task = "visit press then visit rack"   # in place of the problem's
//   margin_m = 0.12              # kept around each link, for what driving deviates
//   top_speed_m_s = 1.2
//   time_s = 10.0                # of wall time until there is a plan
//   seed = 1                     # the same seed has the same plan, unless the time was over
//   threads = 0                  # of the planner, 1 or 2; 0: as many as the machine has
//   hold_s = 3600                # so long the train waits for somebody
//   attended = true              # somebody can see to what the train cannot do; false: then the run ends
//   [[ltl.requests]]             # an operator asks for this at that time
//   at_s = 40.0
//   request = "goal"             # or "block", "unblock" with a name, "hold", "resume"
//   goal = "visit rack"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cell/missions/table/mission_table.h"
#include "runtime/ground/settings/key_words.h"

namespace stepwright::missions {

struct LtlAsked {
  double at_s = 0.0;
  std::string request;
  std::string goal;  // of "goal"
  std::string name;  // of "block", "unblock": a place of the floor
  result::Location where;
};

struct LtlTable final : MissionTable {
  std::filesystem::path problem;
  std::string task;  // empty: the problem's
  double margin_m = 0.12;
  double top_speed_m_s = 1.2;
  double time_s = 10.0;
  std::uint64_t seed = 1;
  std::size_t threads = 0;
  std::chrono::seconds hold{3'600};
  bool attended = true;
  std::vector<LtlAsked> requests;
  result::Location where;  // of `problem`

  std::vector<std::string> unattended() const override { return {"ltl.attended=false"}; }
};

std::shared_ptr<const MissionTable> read_ltl_table(const settings::TomlTable& table, const TablePlace& place);

// What people are told of its keys.
std::span<const settings::KeyWords> ltl_keys();

}  // namespace stepwright::missions
