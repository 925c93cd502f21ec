#include "hmi_web/api/cell_records.h"
#include "hmi_web/api/routes.h"

namespace stepwright::api {
namespace {

using Ask = Answer (CellRecords::*)(const CellRecords::Parameters&) const;

const std::vector<Parameter> kWindow = {
    {"tags", "up to 12 names with ; between them"},
    {"to_ms", "end of the window, ms since 1970; the newest without it"},
    {"from_ms", "its begin"},
    {"span_ms", "or how long it is: an hour without either"},
};
const std::vector<Parameter> kEntries = {
    {"from_ms", "ms since 1970"},
    {"to_ms", "ms since 1970"},
    {"alarm", "part of the alarm's name"},
    {"source", "part of the name of the variable that it watches"},
    {"user", "part of the name of who did it"},
    {"text", "somewhere in name, variable, person or reason"},
    {"state", "into which it went"},
    {"event", "for example raise, acknowledge"},
    {"priority", "critical, high, medium, low: this one or a higher one"},
    {"before", "only entries that are older than the one with this number"},
};

constexpr const char* kSeries =
    R"({"type": "object", "required": ["now_ms", "known_ms", "from_ms", "to_ms", "column_ms", "series"],
  "properties": {"now_ms": {"type": "number"},
    "known_ms": {"type": "number", "description": "no column behind it has a value yet"}, "from_ms": {"type": "number"}, "to_ms": {"type": "number"},
    "column_ms": {"type": "number"}, "series": {"type": "array", "items": {"type": "object",
      "required": ["tag", "least", "greatest", "last", "damaged"], "properties": {"tag": {"type": "string"},
        "least": {"type": "array", "items": {"type": ["number", "null"]}},
        "greatest": {"type": "array", "items": {"type": ["number", "null"]}},
        "last": {"type": "array", "items": {"type": ["number", "null"]}},
        "damaged": {"type": "integer", "description": "blocks that could not be read"}}}}}})";
constexpr const char* kTags = R"({"type": "object", "required": ["now_ms", "tags", "status"],
  "properties": {"now_ms": {"type": "number"}, "tags": {"type": "array", "items": {"type": "string"}},
    "status": {"type": "object"}}})";
constexpr const char* kAlarms = R"({"type": "object", "required": ["count", "alarms", "figures", "journal"],
  "properties": {"count": {"type": "integer"}, "alarms": {"type": "array", "items": {"type": "object"}},
    "figures": {"type": "object"}, "journal": {"type": "object"}}})";
constexpr const char* kJournal = R"({"type": "object", "required": ["entries"],
  "properties": {"entries": {"type": "array", "items": {"type": "object"}}}})";
constexpr const char* kText = R"({"type": "string"})";

// For whoever may look.
Route record_row(const CellRecords* records, const char* path, const char* name, const char* summary,
                 const char* answer, Ask ask) {
  Route route = reading_row(path, name, summary, answer);
  route.answer_type = std::string_view(answer) == kText ? "text/csv" : "application/json";
  route.handler = [records, ask](const Call& call) {
    return records == nullptr ? no_records() : (records->*ask)(call.parameters);
  };
  return route;
}

Route with(Route route, std::vector<Parameter> query, std::vector<Parameter> more = {}) {
  route.query = std::move(query);
  route.query.insert(route.query.end(), more.begin(), more.end());
  return route;
}

Route calendar_row(CellRecords* records) {
  Route route = acting_row(
      "POST", "/api/history/calendar", "history.accept_calendar",
      "The machine's calendar, which has jumped far ahead, is right: the history goes on at its time",
      R"({"type": "object", "required": ["accepted"], "properties": {"accepted": {"type": "boolean"}}})");
  route.least = Role::Engineer;
  route.body = {
      "AcceptCalendar",
      {{.name = "reason", .required = false, .most = 200, .description = "why, for the audit trail"}}};
  route.handler = [records](const Call&) {
    if (records == nullptr) return no_records();
    if (!records->accept_calendar())
      return refused(409, "H0069", "the calendar is believed already", "there is nothing to accept");
    return Answer{.text = R"({"accepted": true})"};
  };
  return route;
}

}  // namespace

Answer no_records() {
  return refused(404, "H0062", "this server keeps neither history nor alarms",
                 "[history] folder = \"history\" in the cell's configuration");
}

std::vector<Route> record_routes(const Services& services) {
  const CellRecords* records = services.records;
  return {
      calendar_row(services.records),
      record_row(records, "/api/history/tags", "history.tags", "Everything that there is a history of", kTags,
                 &CellRecords::tags),
      with(record_row(records, "/api/history/trend", "history.trend",
                      "Least, greatest and last value of every column of a window", kSeries,
                      &CellRecords::trend),
           kWindow, {{"columns", "how many: 1,000 without it, 4,000 at most"}}),
      with(record_row(records, "/api/history/export.csv", "history.export",
                      "Every sample of a window as a table (RFC 4180), up to 32 MB", kText,
                      &CellRecords::samples_csv),
           kWindow),
      with(record_row(records, "/api/alarms", "alarm.list",
                      "Alarms that are not normal, and the figures of all", kAlarms, &CellRecords::alarms),
           {{"all", "1: with those that are normal"}}),
      with(record_row(records, "/api/alarms/journal", "alarm.journal",
                      "What has happened to alarms, the newest first", kJournal, &CellRecords::journal),
           kEntries, {{"most", "how many: 100 without it, 500 at most"}}),
      with(record_row(records, "/api/alarms/journal.csv", "alarm.export",
                      "The same as a table (RFC 4180), up to 100,000 entries", kText,
                      &CellRecords::journal_csv),
           kEntries),
  };
}

}  // namespace stepwright::api
