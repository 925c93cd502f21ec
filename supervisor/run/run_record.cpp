#include "supervisor/run/run_record.h"

#include <algorithm>
#include <array>

#include "supervisor/run/internal/record_json.h"

namespace stepwright::run {
namespace {

using internal::json;

constexpr std::array kActionStates = {"pending", "active", "done", "failed"};
constexpr std::array kPhases = {"planning", "observing", "executing", "replanning", "ready",
                                "waiting",  "holding",   "held",      "done",       "safe"};

template <typename Enum, std::size_t N>
Enum enum_from(const json& value, const std::array<const char*, N>& names) {
  return static_cast<Enum>(internal::index_of_word(value, names.data(), N));
}

json optional_json(const std::optional<double>& value) {
  return value ? json(*value) : json(nullptr);
}

std::optional<double> optional_from(const json& value) {
  return value.is_null() ? std::nullopt : std::optional<double>(value.get<double>());
}

json action_json(const ActionRecord& action, std::size_t index) {
  return {{"index", index},
          {"text", action.text},
          {"step", action.step},
          {"state", to_string(action.state)},
          {"planned_start_s", action.planned_start_s},
          {"planned_finish_s", action.planned_finish_s},
          {"started_s", optional_json(action.started_s)},
          {"finished_s", optional_json(action.finished_s)},
          {"planned_cost", action.planned_cost},
          {"actual_cost", optional_json(action.actual_cost)},
          {"expected", action.expected},
          {"observed", action.observed}};
}

ActionRecord action_from(const json& value) {
  ActionRecord action;
  action.text = value.at("text");
  action.step = value.at("step");
  action.state = enum_from<ActionState>(value.at("state"), kActionStates);
  action.planned_start_s = value.at("planned_start_s");
  action.planned_finish_s = value.at("planned_finish_s");
  action.started_s = optional_from(value.at("started_s"));
  action.finished_s = optional_from(value.at("finished_s"));
  action.planned_cost = value.at("planned_cost");
  action.actual_cost = optional_from(value.at("actual_cost"));
  value.at("expected").get_to(action.expected);
  value.at("observed").get_to(action.observed);
  return action;
}

json episode_json(const Episode& episode) {
  json actions = json::array();
  for (std::size_t i = 0; i < episode.actions.size(); ++i)
    actions.push_back(action_json(episode.actions[i], i));
  return {{"digest", episode.digest},
          {"started_s", episode.started_s},
          {"cost", episode.cost},
          {"bound", optional_json(episode.bound)},
          {"proved_optimal", episode.proved_optimal},
          {"steps", episode.actions.size()},
          {"first_plan_ms", episode.first_plan_ms},
          {"optimal_plan_ms", episode.optimal_plan_ms},
          {"origin", episode.origin},
          {"kept", episode.kept},
          {"remaining", episode.remaining},
          {"repair_ms", episode.repair_ms},
          {"replan_ms", episode.replan_ms},
          {"planned_makespan_s", episode.planned_makespan_s},
          {"planned_sequential_makespan_s", episode.planned_sequential_makespan_s},
          {"actions", std::move(actions)}};
}

Episode episode_from(const json& value) {
  Episode episode;
  episode.digest = value.at("digest");
  episode.started_s = value.at("started_s");
  episode.cost = value.at("cost");
  episode.bound = optional_from(value.at("bound"));
  episode.proved_optimal = value.at("proved_optimal");
  episode.first_plan_ms = value.at("first_plan_ms");
  episode.optimal_plan_ms = value.at("optimal_plan_ms");
  episode.origin = value.at("origin");
  episode.kept = value.at("kept");
  episode.remaining = value.at("remaining");
  episode.repair_ms = value.at("repair_ms");
  episode.replan_ms = value.at("replan_ms");
  episode.planned_makespan_s = value.at("planned_makespan_s");
  episode.planned_sequential_makespan_s = value.at("planned_sequential_makespan_s");
  for (const json& action : value.at("actions")) episode.actions.push_back(action_from(action));
  return episode;
}

}  // namespace

const char* to_string(ActionState state) {
  return kActionStates[static_cast<std::size_t>(state)];
}
std::size_t counted(const std::vector<Replan>& replans) {
  return static_cast<std::size_t>(std::ranges::count(replans, false, &Replan::held));
}

const char* to_string(Phase phase) {
  return kPhases[static_cast<std::size_t>(phase)];
}

std::string to_json(const RunRecord& record) {
  return internal::text_of(internal::record_json(record));
}

result::Result<RunRecord> record_from_json(const std::string& text, const std::string& file) {
  return internal::read_text(text, file, "run record", [](const json& value) {
    return result::Result<RunRecord>(internal::record_from(value));
  });
}

namespace internal {

std::size_t index_of_word(const json& value, const char* const* names, std::size_t count) {
  const std::string text = value.get<std::string>();
  for (std::size_t i = 0; i < count; ++i) {
    if (text == names[i]) return i;
  }
  throw json::other_error::create(501, "unknown word '" + text + "'", &value);
}

std::string text_of(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

json record_json(const RunRecord& record) {
  json episodes = json::array();
  for (const Episode& episode : record.episodes) episodes.push_back(episode_json(episode));
  json replans = json::array();
  for (const Replan& replan : record.replans) {
    replans.push_back({{"time_s", replan.time_s},
                       {"cause", replan.cause},
                       {"after_action", replan.after_action},
                       {"held", replan.held}});
  }
  json incidents = json::array();
  for (const Incident& incident : record.incidents) incidents.push_back(incident_json(incident));
  json goal = json::array();
  for (const GoalRecord& entry : record.goal) goal.push_back({{"text", entry.text}, {"met", entry.met}});
  json document = {{"cell", record.cell},
                   {"phase", to_string(record.phase)},
                   {"message", record.message},
                   {"exit_code", result::to_int(record.exit)},
                   {"episodes", std::move(episodes)},
                   {"replans", std::move(replans)},
                   {"incidents", std::move(incidents)},
                   {"goal", std::move(goal)},
                   {"expected", record.expected},
                   {"observed", record.observed},
                   {"tare", record.tare},
                   {"started_s", record.started_s},
                   {"finished_s", record.finished_s},
                   {"makespan_s", record.finished_s - record.started_s}};
  for (const auto& [name, text] : record.details)
    if (!document.contains(name)) document[name] = json::parse(text, nullptr, false);
  if (!record.episodes.empty()) {  // viewers show the newest plan
    const json& newest = document["episodes"].back();
    document["program_digest"] = newest["digest"];
    document["plan"] = {{"cost", newest["cost"]},
                        {"bound", newest["bound"]},
                        {"proved_optimal", newest["proved_optimal"]},
                        {"steps", newest["steps"]},
                        {"first_plan_ms", newest["first_plan_ms"]},
                        {"optimal_plan_ms", newest["optimal_plan_ms"]}};
    document["actions"] = newest["actions"];
  }
  return document;
}

RunRecord record_from(const json& value) {
  RunRecord record;
  record.cell = value.at("cell");
  record.phase = enum_from<Phase>(value.at("phase"), kPhases);
  record.message = value.at("message");
  record.exit = static_cast<result::ExitCode>(value.at("exit_code").get<int>());
  for (const json& episode : value.at("episodes")) record.episodes.push_back(episode_from(episode));
  for (const json& replan : value.at("replans")) {
    record.replans.push_back(
        {replan.at("time_s"), replan.at("cause"), replan.at("after_action"), replan.value("held", false)});
  }
  for (const json& incident : value.at("incidents")) record.incidents.push_back(incident_from(incident));
  for (const json& goal : value.at("goal")) record.goal.push_back({goal.at("text"), goal.at("met")});
  value.at("expected").get_to(record.expected);
  value.at("observed").get_to(record.observed);
  value.at("tare").get_to(record.tare);
  record.started_s = value.at("started_s");
  record.finished_s = value.at("finished_s");
  RunRecord whole;
  whole.episodes.emplace_back();
  const json own = record_json(whole);
  for (const auto& [name, detail] : value.items())
    if (!own.contains(name)) record.details[name] = text_of(detail);
  return record;
}

}  // namespace internal
}  // namespace stepwright::run
