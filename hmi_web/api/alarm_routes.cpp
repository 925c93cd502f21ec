#include <nlohmann/json.hpp>

#include "hmi_web/api/cell_records.h"
#include "hmi_web/api/routes.h"

namespace stepwright::api {
namespace {

const Field kAlarmName{.name = "name", .least = 1, .most = 256, .description = "of the alarm"};
// It stands in the journal of alarms, too.
const Field kAlarmComment{
    .name = "reason", .required = false, .most = 200, .description = "why, for journal and audit trail"};
const Field kAlarmReason{
    .name = "reason", .least = 3, .most = 200, .description = "why, for journal and audit trail"};
const Field kShelfMinutes{.name = "minutes",
                          .kind = Kind::Number,
                          .least = 1,
                          .most = 10'080,
                          .description = "after which it is shown again by itself; the alarm may allow less"};

struct AlarmCommand {
  const char* path;
  const char* name;
  const char* event;  // of alarms::AlarmEvent
  Role least;
  const char* summary;
  Shape body;
};

const std::vector<AlarmCommand>& alarm_commands() {
  static const std::vector<AlarmCommand> kCommands = {
      {"/api/alarms/acknowledge",
       "alarm.acknowledge",
       "acknowledge",
       Role::Operator,
       "Somebody has seen it",
       {"AlarmAcknowledge", {kAlarmName, kAlarmComment}}},
      {"/api/alarms/reset",
       "alarm.reset",
       "reset",
       Role::Operator,
       "Ends a latch, once the condition is gone and acknowledged",
       {"AlarmReset", {kAlarmName, kAlarmComment}}},
      {"/api/alarms/shelve",
       "alarm.shelve",
       "shelve",
       Role::Operator,
       "Hides it for a time",
       {"AlarmShelve", {kAlarmName, kShelfMinutes, kAlarmReason}}},
      {"/api/alarms/unshelve",
       "alarm.unshelve",
       "unshelve",
       Role::Operator,
       "Shows it again before its time is over",
       {"AlarmUnshelve", {kAlarmName, kAlarmComment}}},
      {"/api/alarms/suppress",
       "alarm.suppress",
       "suppress",
       Role::Operator,
       "Hides it until somebody ends that, where its design allows it (suppress_by_hand)",
       {"AlarmSuppress", {kAlarmName, kAlarmReason}}},
      {"/api/alarms/unsuppress",
       "alarm.unsuppress",
       "unsuppress",
       Role::Operator,
       "Ends that",
       {"AlarmUnsuppress", {kAlarmName, kAlarmComment}}},
      {"/api/alarms/remove",
       "alarm.remove",
       "remove from service",
       Role::Engineer,
       "Out of service, as for maintenance, until it is returned",
       {"AlarmRemove", {kAlarmName, kAlarmReason}}},
      {"/api/alarms/return",
       "alarm.return",
       "return to service",
       Role::Engineer,
       "Back in service",
       {"AlarmReturn", {kAlarmName, kAlarmComment}}},
  };
  return kCommands;
}

Answer done(const result::Result<AlarmChange>& change, const AlarmAction& action) {
  Answer answer;
  if (change) {
    answer.text = nlohmann::json{{"name", action.alarm}, {"state", change->after}}.dump();
    answer.before = change->before;
    answer.after = change->after;
  } else {
    answer = refused(change.error());
    answer.after = action.event;
  }
  if (action.shelve_for.count() > 0)
    answer.after += " for " + std::to_string(action.shelve_for.count()) + " min";
  answer.target = action.alarm;
  return answer;
}

Route alarm_row(CellRecords* records, const AlarmCommand& command) {
  Route route = acting_row("POST", command.path, command.name, command.summary,
                           R"({"type": "object", "required": ["name", "state"],
  "properties": {"name": {"type": "string"}, "state": {"type": "string"}}})");
  route.least = command.least;
  route.body = command.body;
  route.handler = [records, event = std::string(command.event)](const Call& call) {
    if (records == nullptr) return no_records();
    AlarmAction action;
    action.alarm = call.body.text("name");
    action.event = event;
    action.user = call.who.user;
    action.comment = call.body.text("reason");
    action.shelve_for = std::chrono::minutes(static_cast<int>(call.body.number("minutes")));
    return done(records->act(action), action);
  };
  return route;
}

}  // namespace

std::vector<Route> alarm_routes(const Services& services) {
  std::vector<Route> rows;
  for (const AlarmCommand& command : alarm_commands()) rows.push_back(alarm_row(services.records, command));
  return rows;
}

}  // namespace stepwright::api
