#include "supervisor/run/incident.h"

#include <fmt/format.h>

#include <array>

#include "supervisor/run/internal/record_json.h"

namespace stepwright::run {
namespace {

using internal::json;

constexpr std::array kKinds = {
    "level",          "position",        "timeout",         "refused", "new_goal",
    "changed_demand", "failed_actuator", "failed_sensor",   "leak",    "lost_runtime",
    "program_fault",  "operator",        "lost_supervisor", "monitor"};
constexpr std::array kResponses = {"open", "go_on", "repair", "replan", "safe_stop"};

json alarm_json(const Alarm& alarm) {
  return {{"action", alarm.action}, {"kind", alarm.kind},   {"condition", alarm.condition},
          {"scan", alarm.scan},     {"value", alarm.value}, {"sensor", alarm.sensor}};
}

}  // namespace

const char* to_string(IncidentKind kind) {
  return kKinds[static_cast<std::size_t>(kind)];
}

const char* to_string(Response response) {
  return kResponses[static_cast<std::size_t>(response)];
}

std::string to_string(const Alarm& alarm) {
  const std::string of = alarm.action.empty() ? "" : " of " + alarm.action;
  return fmt::format("{}{} lost in scan {}: {} ({:.4g})", alarm.kind, of, alarm.scan, alarm.condition,
                     alarm.value);
}

namespace internal {

json incident_json(const Incident& incident) {
  json alarms = json::array();
  for (const Alarm& alarm : incident.alarms) alarms.push_back(alarm_json(alarm));
  return {{"time_s", incident.time_s},
          {"kind", to_string(incident.kind)},
          {"evidence", incident.evidence},
          {"action", incident.action},
          {"alarms", std::move(alarms)},
          {"decision", to_string(incident.response)},
          {"decision_ms", incident.decision_ms},
          {"repair_ms", incident.repair_ms},
          {"replan_ms", incident.replan_ms},
          {"retime_ms", incident.retime_ms},
          {"kept", incident.kept},
          {"remaining", incident.remaining},
          {"restarts", incident.restarts},
          {"devices", incident.devices}};
}

Incident incident_from(const json& value) {
  Incident incident;
  incident.time_s = value.at("time_s");
  incident.kind = static_cast<IncidentKind>(index_of_word(value.at("kind"), kKinds.data(), kKinds.size()));
  value.at("evidence").get_to(incident.evidence);
  value.at("devices").get_to(incident.devices);
  incident.action = value.at("action");
  for (const json& alarm : value.at("alarms")) {
    incident.alarms.push_back({alarm.at("action"), alarm.at("kind"), alarm.at("condition"), alarm.at("scan"),
                               alarm.at("value"), alarm.at("sensor")});
  }
  incident.response =
      static_cast<Response>(index_of_word(value.at("decision"), kResponses.data(), kResponses.size()));
  incident.decision_ms = value.at("decision_ms");
  incident.repair_ms = value.at("repair_ms");
  incident.replan_ms = value.at("replan_ms");
  incident.retime_ms = value.value("retime_ms", 0.0);  // journals from before have none
  incident.kept = value.at("kept");
  incident.remaining = value.at("remaining");
  incident.restarts = value.at("restarts");
  return incident;
}

}  // namespace internal
}  // namespace stepwright::run
