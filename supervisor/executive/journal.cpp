#include "supervisor/executive/journal.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace stepwright::executive {
namespace {

using nlohmann::json;

constexpr int kVersion = 1;

json plan_json(const model::Plan& plan) {
  json actions = json::array();
  for (const model::GroundAction& action : plan.actions) {
    actions.push_back({{"name", action.name}, {"arguments", action.arguments}});
  }
  json orderings = json::array();
  for (const model::Ordering& ordering : plan.orderings) {
    orderings.push_back({ordering.before, ordering.after});
  }
  return {{"actions", std::move(actions)},
          {"orderings", std::move(orderings)},
          {"cost", plan.cost},
          {"bound", plan.bound},
          {"proved_optimal", plan.proved_optimal}};
}

model::Plan plan_from(const json& value) {
  model::Plan plan;
  for (const json& action : value.at("actions")) {
    plan.actions.push_back({action.at("name"), action.at("arguments").get<std::vector<std::string>>()});
  }
  for (const json& ordering : value.at("orderings")) {
    plan.orderings.push_back({ordering.at(0).get<std::size_t>(), ordering.at(1).get<std::size_t>()});
  }
  plan.cost = value.at("cost");
  plan.bound = value.at("bound");
  plan.proved_optimal = value.at("proved_optimal");
  return plan;
}

json start_json(const StartState& start) {
  return {{"facts", start.planning.facts},
          {"fluents", start.planning.fluents},
          {"measured", start.measured},
          {"tare", start.tare}};
}

StartState start_from(const json& value) {
  StartState start;
  value.at("facts").get_to(start.planning.facts);
  value.at("fluents").get_to(start.planning.fluents);
  value.at("measured").get_to(start.measured);
  value.at("tare").get_to(start.tare);
  return start;
}

}  // namespace

result::Result<void> write_journal(const std::filesystem::path& file, const Journal& journal) {
  const json document = {{"version", kVersion},
                         {"record", json::parse(to_json(journal.record))},
                         {"start", start_json(journal.start)},
                         {"plan", plan_json(journal.plan)},
                         {"changed", journal.changed},
                         {"next_change", journal.next_change}};
  const std::filesystem::path fresh = file.string() + ".new";
  std::ofstream out(fresh, std::ios::trunc);
  out << document.dump() << '\n';
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(fresh, file, error);
  if (!out || error) {
    return result::fail("X0004", {file.string(), 0, 0}, "the journal cannot be written",
                        "is the state folder there, and is there room on the disk?");
  }
  return {};
}

result::Result<std::optional<Journal>> read_journal(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) return std::optional<Journal>();
  std::stringstream text;
  text << in.rdbuf();
  try {
    const json document = json::parse(text.str());
    if (document.at("version") != kVersion) {
      return result::fail("X0001", {file.string(), 0, 0}, "a journal of another version",
                          "delete the file to start afresh");
    }
    auto record = record_from_json(document.at("record").dump(), file.string());
    if (!record) return result::forward(record);
    Journal journal;
    journal.record = std::move(*record);
    journal.start = start_from(document.at("start"));
    journal.plan = plan_from(document.at("plan"));
    document.at("changed").get_to(journal.changed);
    journal.next_change = document.at("next_change");
    return std::optional<Journal>(std::move(journal));
  } catch (const json::exception& problem) {
    return result::fail("X0001", {file.string(), 0, 0}, std::string("not a journal: ") + problem.what(),
                        "delete the file to start afresh");
  }
}

}  // namespace stepwright::executive
