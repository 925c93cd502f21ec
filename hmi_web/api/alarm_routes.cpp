#include <nlohmann/json.hpp>

#include "hmi_web/api/cell_records.h"
#include "hmi_web/api/routes.h"
#include "runtime/ground/result/counted.h"

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
                          .whole = true,
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

constexpr double kMostAtOnce = 200;

// Each is checked and audited as if it had been asked for alone.
Answer acknowledge_all(CellRecords& records, access::AuditLog& audit, const Call& call) {
  nlohmann::json done = nlohmann::json::array();
  nlohmann::json refusals = nlohmann::json::array();
  for (const std::string& name : call.body.list("names")) {
    const auto change =
        records.act({name, "acknowledge", call.who.user, call.body.text("reason"), std::chrono::minutes(0)});
    access::AuditEntry entry{.user = call.who.user,
                             .role = access::to_string(call.who.role),
                             .address = call.who.address,
                             .action = "alarm.acknowledge",
                             .target = name,
                             .reason = call.body.text("reason")};
    if (change) {
      entry.before = change->before;
      entry.after = change->after;
      entry.result = "done";
      done.push_back({{"name", name}, {"state", change->after}});
    } else {
      const result::Diagnostic& why = change.error().front();
      entry.result = "refused: " + why.code + ": " + why.message;
      refusals.push_back({{"name", name}, {"code", why.code}, {"message", why.message}});
    }
    if (!audit.append(entry))
      return refused(503, "H0046", "'" + name + "' was looked at, but the audit trail could not be written",
                     "is the disk full? Nothing was done to the others");
  }
  Answer answer;
  answer.target = result::counted(done.size() + refusals.size(), "alarm", "alarms");
  answer.after = std::to_string(done.size()) + " acknowledged";
  answer.text = nlohmann::json{{"done", std::move(done)}, {"refused", std::move(refusals)}}.dump(
      -1, ' ', false, nlohmann::json::error_handler_t::replace);
  return answer;
}

Route acknowledge_all_row(const Services& services) {
  Route route = acting_row("POST", "/api/alarms/acknowledge-all", "alarm.acknowledge_all",
                           "Somebody has seen these; each is checked and audited by itself",
                           R"({"type": "object", "required": ["done", "refused"], "properties": {
  "done": {"type": "array", "items": {"type": "object", "required": ["name", "state"]}},
  "refused": {"type": "array", "items": {"type": "object", "required": ["name", "code", "message"]}}}})");
  route.least = Role::Operator;
  route.body = {"AlarmAcknowledgeAll",
                {{.name = "names",
                  .kind = Kind::List,
                  .least = 1,
                  .most = kMostAtOnce,
                  .longest = 256,
                  .description = "of the alarms that were in sight"},
                 kAlarmComment}};
  route.handler = [records = services.records, audit = services.audit](const Call& call) {
    return records == nullptr ? no_records() : acknowledge_all(*records, *audit, call);
  };
  return route;
}

}  // namespace

std::vector<Route> alarm_routes(const Services& services) {
  std::vector<Route> rows = {acknowledge_all_row(services)};
  for (const AlarmCommand& command : alarm_commands()) rows.push_back(alarm_row(services.records, command));
  return rows;
}

}  // namespace stepwright::api
