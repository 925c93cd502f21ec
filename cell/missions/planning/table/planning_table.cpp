#include "cell/missions/planning/table/planning_table.h"

namespace stepwright::missions {

std::shared_ptr<const MissionTable> read_planning_table(const settings::TomlTable& table,
                                                        const TablePlace& place) {
  auto planning = std::make_shared<PlanningTable>();
  planning->domain = required_file(table, "domain", place.folder);
  planning->problem = required_file(table, "problem", place.folder);
  planning->binding = required_file(table, "binding", place.folder);
  for (const std::string& text : table.texts("programs"))
    planning->programs.push_back(file_of(table, "programs", place.folder, text));
  std::vector<std::string> dialects;
  for (const source::Dialect& each : source::dialects()) dialects.emplace_back(each.name);
  planning->written_in = source::find_dialect(table.choice("dialect", dialects.front(), dialects));
  planning->optimal = table.boolean("optimal", planning->optimal);
  planning->sequential = table.boolean("sequential", planning->sequential);
  const std::string otherwise = place.real_io ? "observed" : "problem";
  planning->initial = table.choice("initial", otherwise, {"problem", "observed"}) == "observed"
                          ? InitialState::Observed
                          : InitialState::Problem;
  planning->monitors = table.boolean("monitors", planning->monitors);
  planning->time =
      std::chrono::milliseconds(table.integer("time_ms", planning->time.count(), {1, 86'400'000}));
  return planning;
}

}  // namespace stepwright::missions
