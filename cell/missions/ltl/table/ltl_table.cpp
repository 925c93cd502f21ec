#include "cell/missions/ltl/table/ltl_table.h"

#include <utility>

namespace stepwright::missions {
namespace {

LtlAsked read_asked(const settings::TomlTable& table) {
  LtlAsked asked;
  asked.at_s = table.required_number("at_s", {0.0, 1e9});
  asked.request = table.required_text("request");
  asked.goal = table.text("goal", "");
  asked.name = table.text("name", "");
  asked.where = table.where("request");
  const bool named = asked.request == "block" || asked.request == "unblock";
  const bool known = named || asked.request == "goal" || asked.request == "hold" || asked.request == "resume";
  if (!known && !asked.request.empty())
    table.report("request", "nobody can ask for '" + asked.request + "'",
                 R"("goal", "block", "unblock", "hold" or "resume")");
  if (known && (asked.request == "goal") == asked.goal.empty())
    table.report("request", "a goal comes with \"goal\", and nothing else does", "goal = \"visit press\"");
  if (known && named == asked.name.empty())
    table.report("request", "what is blocked or free again has a name, and nothing else",
                 "name = \"press\", a place of the floor");
  return asked;
}

}  // namespace

std::shared_ptr<const MissionTable> read_ltl_table(const settings::TomlTable& ltl, const TablePlace& place) {
  auto mission = std::make_shared<LtlTable>();
  mission->problem = required_file(ltl, "problem", place.folder);
  mission->where = ltl.where("problem");
  mission->task = ltl.text("task", "");
  mission->margin_m = ltl.number("margin_m", mission->margin_m, {0.0, 10.0});
  mission->top_speed_m_s = ltl.number("top_speed_m_s", mission->top_speed_m_s, {0.05, 10.0});
  mission->time_s = ltl.number("time_s", mission->time_s, {0.01, 86'400.0});
  mission->seed = static_cast<std::uint64_t>(ltl.integer("seed", 1, {0, 1'000'000'000}));
  mission->threads = static_cast<std::size_t>(ltl.integer("threads", 0, {0, 2}));
  mission->hold = std::chrono::seconds(ltl.integer("hold_s", mission->hold.count(), {0, 31'536'000}));
  mission->attended = ltl.boolean("attended", mission->attended);
  for (const settings::TomlTable& table : ltl.tables("requests"))
    mission->requests.push_back(read_asked(table));
  return mission;
}

}  // namespace stepwright::missions
