#include "supervisor/executive/journal.h"

#include "supervisor/run/internal/journal_json.h"

namespace stepwright::executive {
namespace {

using run::internal::json;

constexpr run::internal::JournalForm kForm{"journal", 3};

json plan_json(const model::Plan& plan) {
  json actions = json::array();
  for (const model::GroundAction& action : plan.actions) {
    actions.push_back({{"name", action.name}, {"arguments", action.arguments}});
  }
  json orderings;  // null: not known
  if (plan.orderings) orderings = json::array();
  for (const model::Ordering& ordering : plan.orderings.value_or(std::vector<model::Ordering>())) {
    orderings.push_back({ordering.before, ordering.after});
  }
  return {{"actions", std::move(actions)}, {"orderings", std::move(orderings)}};
}

model::Plan plan_from(const json& value) {
  model::Plan plan;
  for (const json& action : value.at("actions")) {
    plan.actions.push_back({action.at("name"), action.at("arguments").get<std::vector<std::string>>()});
  }
  if (!value.at("orderings").is_null()) plan.orderings.emplace();
  for (const json& ordering : value.at("orderings")) {
    plan.orderings->push_back({ordering.at(0).get<std::size_t>(), ordering.at(1).get<std::size_t>()});
  }
  return plan;
}

json start_json(const StartState& start) {
  return {{"facts", start.planning.facts},
          {"fluents", start.planning.fluents},
          {"measured", start.measured},
          {"tare", start.tare},
          {"goal", start.goal}};
}

StartState start_from(const json& value) {
  StartState start;
  value.at("facts").get_to(start.planning.facts);
  value.at("fluents").get_to(start.planning.fluents);
  value.at("measured").get_to(start.measured);
  value.at("tare").get_to(start.tare);
  start.goal = value.at("goal");
  return start;
}

// A journal of one plan and a record of another would send everything that follows astray.
bool consistent(const Journal& journal) {
  const std::vector<run::Episode>& episodes = journal.record.episodes;
  // Of a run that is over nothing follows. Its last plan may have been empty, which makes no episode.
  if (journal.record.phase == run::Phase::Done || journal.record.phase == run::Phase::Safe) return true;
  return episodes.empty() || episodes.back().actions.size() == journal.plan.actions.size();
}

const char* own_from(const json& document, Journal& journal) {
  journal.start = start_from(document.at("start"));
  journal.plan = plan_from(document.at("plan"));
  document.at("changed").get_to(journal.changed);
  if (document.contains("held")) {  // a journal that an earlier version has left has none of these
    journal.held = document.at("held");
    journal.known = document.at("known");
    document.at("seen").at("facts").get_to(journal.seen.facts);
    document.at("seen").at("fluents").get_to(journal.seen.fluents);
  }
  return consistent(journal) ? nullptr : "its record does not fit its plan";
}

}  // namespace

result::Result<void> write_journal(const std::filesystem::path& file, const Journal& journal) {
  return run::internal::write_journal(
      file, kForm, journal,
      {{"start", start_json(journal.start)},
       {"plan", plan_json(journal.plan)},
       {"changed", journal.changed},
       {"held", journal.held},
       {"known", journal.known},
       {"seen", {{"facts", journal.seen.facts}, {"fluents", journal.seen.fluents}}}});
}

result::Result<std::optional<Journal>> read_journal(const std::filesystem::path& file) {
  return run::internal::read_journal<Journal>(file, kForm, own_from);
}

}  // namespace stepwright::executive
