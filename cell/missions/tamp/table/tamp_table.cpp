#include "cell/missions/tamp/table/tamp_table.h"

#include <algorithm>
#include <utility>

namespace stepwright::missions {
namespace {

TampAsked read_asked(const settings::TomlTable& table) {
  TampAsked asked;
  asked.at_s = table.required_number("at_s", {0.0, 1e9});
  asked.request = table.required_text("request");
  asked.goal = table.text("goal", "");
  asked.where = table.where("request");
  const bool known = asked.request == "goal" || asked.request == "hold" || asked.request == "resume";
  if (!known && !asked.request.empty())
    table.report("request", "nobody can ask for '" + asked.request + "'", R"("goal", "hold" or "resume")");
  if (known && (asked.request == "goal") == asked.goal.empty())
    table.report("request", "a goal comes with \"goal\", and nothing else does", "goal = \"P2\"");
  return asked;
}

}  // namespace

std::shared_ptr<const MissionTable> read_tamp_table(const settings::TomlTable& tamp,
                                                    const TablePlace& place) {
  auto mission = std::make_shared<TampTable>();
  mission->problem = required_file(tamp, "problem", place.folder);
  mission->where = tamp.where("problem");
  if (const std::string domain = tamp.text("domain", ""); !domain.empty())
    mission->domain = file_of(tamp, "domain", place.folder, domain);
  mission->order = tamp.text("order", "");
  mission->order_where = tamp.where("order");
  mission->exchange = tamp.texts("exchange");
  mission->exchange_where = tamp.where("exchange");
  mission->time_s = tamp.number("time_s", mission->time_s, {0.01, 86'400.0});
  mission->seed = static_cast<std::uint64_t>(tamp.integer("seed", 1, {0, 1'000'000'000}));
  mission->retries = static_cast<int>(tamp.integer("retries", mission->retries, {0, 1000}));
  mission->following_rad = tamp.number("following_rad", mission->following_rad, {0.001, 1.0});
  mission->pictures =
      std::chrono::milliseconds(tamp.integer("pictures_ms", mission->pictures.count(), {100, 60'000}));
  mission->hold = std::chrono::seconds(tamp.integer("hold_s", mission->hold.count(), {0, 31'536'000}));
  mission->attended = tamp.boolean("attended", mission->attended);
  for (const settings::TomlTable& table : tamp.tables("orders")) {
    TampOrder order{table.required_text("name"), table.required_text("goal"), table.where("goal")};
    if (std::ranges::find(mission->orders, order.name, &TampOrder::name) != mission->orders.end())
      table.report("name", "there are two orders '" + order.name + "'", "names tell orders apart");
    mission->orders.push_back(std::move(order));
  }
  if (mission->orders.empty())
    tamp.report("orders", "there is no order", "[[tamp.orders]] with a name and a goal");
  const bool known =
      std::ranges::find(mission->orders, mission->order, &TampOrder::name) != mission->orders.end();
  if (!mission->order.empty() && !mission->order.starts_with('(') && !known)
    tamp.report("order", "there is no order '" + mission->order + "'",
                "the name of one of [[tamp.orders]], or a goal");
  for (const settings::TomlTable& table : tamp.tables("requests"))
    mission->requests.push_back(read_asked(table));
  return mission;
}

}  // namespace stepwright::missions
