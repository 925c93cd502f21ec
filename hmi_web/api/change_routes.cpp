#include <nlohmann/json.hpp>

#include "hmi_web/access/secrets.h"
#include "hmi_web/api/internal/problems_json.h"
#include "hmi_web/api/internal/service_row.h"
#include "hmi_web/api/online_change_service.h"
#include "hmi_web/api/routes.h"

namespace stepwright::api {
namespace {

using nlohmann::json;

// Of a list in an answer: the page says how many more there are.
constexpr std::size_t kMostShown = 500;
// A container in base64 takes four bytes for three.
constexpr std::size_t kMostBase64 = change::kMostContainerBytes / 3 * 4 + 8;
constexpr std::size_t kMostBody = kMostBase64 + 65'536;

const Field kName{.name = "name",
                  .required = false,
                  .least = 1,
                  .most = static_cast<double>(kLongestSourceName),
                  .description = "of the file with the container"};
const Field kContainer{.name = "container",
                       .required = false,
                       .least = 4,
                       .most = static_cast<double>(kMostBase64),
                       .description = "a compiled program (stepwright compile) in base64"};
const Field kFiles{
    .name = "files",
    .kind = Kind::Texts,
    .required = false,
    .least = 1,
    .most = static_cast<double>(kMostSources),
    .longest = kMostSourceBytes,
    .description = "instead of it the text of every source by its name: ST, or PLCopen (.xml)"};
const Field kProgram{.name = "program", .least = 64, .most = 64, .description = "digest of the new program"};
const Field kBase{.name = "base",
                  .least = 64,
                  .most = 64,
                  .description = "digest of the running program that it was compared with"};
const Field kCharts{.name = "charts",
                    .choices = {"keep", "restart"},
                    .description = "whether charts go on where they are or begin at their initial steps"};
const Field kReason{.name = "reason", .least = 3, .most = 200, .description = "why, for the audit trail"};

constexpr const char* kCandidate = R"({"type": "object", "required": ["program", "name", "bytes", "warnings"],
  "properties": {"program": {"type": "string"}, "name": {"type": "string"}, "bytes": {"type": "integer"},
    "warnings": {"type": "array", "items": {"type": "object"}}}})";
constexpr const char* kComparison = R"({"type": "object",
  "required": ["running", "program", "carried", "lists", "steps", "refusals"],
  "properties": {"running": {"type": "string"}, "program": {"type": "string"}, "carried": {"type": "integer"},
    "lists": {"type": "object", "additionalProperties": {"type": "object", "required": ["count", "rows"],
      "properties": {"count": {"type": "integer"}, "rows": {"type": "array", "items": {"type": "object",
        "required": ["name", "before", "after"]}}}}},
    "steps": {"type": "object", "required": ["added", "removed"]},
    "refusals": {"type": "object", "required": ["now", "keep", "restart"]}}})";
constexpr const char* kSources =
    R"({"type": "object", "required": ["digest", "state", "instances", "document"]})";
constexpr const char* kRecord = R"({"type": "object", "required": ["program", "base", "outcome", "takeover"],
  "properties": {"program": {"type": "string"}, "base": {"type": "string"}, "name": {"type": "string"},
    "user": {"type": "string"}, "reason": {"type": "string"}, "when_ms": {"type": "integer"},
    "charts": {"enum": ["keep", "restart"]},
    "outcome": {"enum": ["trial", "kept", "rolled_back", "ended"]}, "scan": {"type": "integer"},
    "scans": {"type": "integer"}, "why": {"type": "string"}, "takeover": {"type": "object"}}})";
constexpr const char* kState = R"({"type": "object",
  "required": ["running", "engaged", "newest", "versions", "damaged"],
  "properties": {"running": {"type": "string"}, "engaged": {"type": "string"},
    "newest": {"type": ["object", "null"]}, "damaged": {"type": "array", "items": {"type": "string"}},
    "versions": {"type": "array", "items": {"type": "object",
      "required": ["program", "name", "user", "reason", "replaced", "when_ms", "outcome", "note"]}}}})";

Answer no_change() {
  return refused(404, "H0090", "programs cannot be changed from this server");
}

Answer told(const json& document) {
  return Answer{.text = document.dump(-1, ' ', false, json::error_handler_t::replace)};
}

std::int64_t milliseconds_of(std::chrono::system_clock::time_point time) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch()).count();
}

const char* word_of(result::Severity severity) {
  return severity == result::Severity::Error     ? "error"
         : severity == result::Severity::Warning ? "warning"
                                                 : "note";
}

json judged(const result::Diagnostics& problems) {
  json list = json::array();
  for (const result::Diagnostic& each : problems) {
    if (list.size() == kMostShown) break;
    json entry = problem_json(each);
    entry["severity"] = word_of(each.severity);
    list.push_back(std::move(entry));
  }
  return list;
}

Answer refused_with_severities(const result::Diagnostics& problems) {
  Answer answer = refused(problems);
  answer.text = told({{"problems", judged(problems)}}).text;
  return answer;
}

json rows(const std::vector<change::Difference>& list) {
  json shown = json::array();
  for (const change::Difference& each : list) {
    if (shown.size() == kMostShown) break;
    shown.push_back({{"name", each.name}, {"before", each.before}, {"after", each.after}});
  }
  return {{"count", list.size()}, {"rows", std::move(shown)}};
}

json rows(const std::vector<change::StepDifference>& list) {
  json shown = json::array();
  for (const change::StepDifference& each : list) {
    if (shown.size() == kMostShown) break;
    shown.push_back({{"name", each.name}, {"active", each.active}});
  }
  return {{"count", list.size()}, {"rows", std::move(shown)}};
}

json comparison_json(const Comparison& seen) {
  const change::ProgramDiff& diff = seen.diff;
  return {
      {"running", seen.running},
      {"program", seen.program},
      {"carried", diff.carried},
      {"lists",
       {{"added", rows(diff.added)},
        {"removed", rows(diff.removed)},
        {"retyped", rows(diff.retyped)},
        {"shortened", rows(diff.shortened)},
        {"references", rows(diff.references)},
        {"moved", rows(diff.moved)},
        {"tasks", rows(diff.tasks)}}},
      {"steps", {{"added", rows(diff.steps_added)}, {"removed", rows(diff.steps_removed)}}},
      {"refusals",
       {{"now", judged(seen.now)}, {"keep", judged(diff.keep)}, {"restart", judged(diff.restart_charts)}}}};
}

const char* word_of(Trial::State state) {
  switch (state) {
    case Trial::State::Kept:
      return "kept";
    case Trial::State::RolledBack:
      return "rolled_back";
    case Trial::State::Ended:
      return "ended";
    default:
      return "trial";
  }
}

json record_json(const ChangeRecord& record) {
  const Takeover& takeover = record.takeover;
  return {{"program", record.order.program},
          {"base", record.order.base},
          {"name", record.name},
          {"user", record.order.user},
          {"reason", record.order.reason},
          {"when_ms", milliseconds_of(record.when)},
          {"charts", record.order.restart_charts ? "restart" : "keep"},
          {"outcome", word_of(record.trial.state)},
          {"scan", record.trial.scan},
          {"scans", record.trial.scans},
          {"why", record.trial.why},
          {"takeover",
           {{"carried", takeover.carried},
            {"initialised", takeover.initialised},
            {"dropped", takeover.dropped},
            {"retyped", takeover.retyped},
            {"dropped_forces", takeover.dropped_forces},
            {"pause_us", takeover.pause_us},
            {"notes", takeover.notes}}}};
}

Answer state_of(OnlineChangeService& service) {
  json versions = json::array();
  for (const change::Version& each : service.versions()) {
    versions.push_back({{"program", each.digest},
                        {"name", each.name},
                        {"user", each.user},
                        {"reason", each.reason},
                        {"replaced", each.replaced},
                        {"when_ms", milliseconds_of(each.when)},
                        {"outcome", change::to_string(each.outcome)},
                        {"note", each.note}});
  }
  json damaged = json::array();
  for (const result::Diagnostic& each : service.damaged()) {
    const std::size_t slash = each.where.file.rfind('/');
    damaged.push_back(each.where.file.substr(slash == std::string::npos ? 0 : slash + 1) + ": " +
                      each.message);
  }
  const auto newest = service.newest();
  return told({{"running", service.running()},
               {"engaged", service.engaged()},
               {"newest", newest ? record_json(*newest) : json()},
               {"versions", std::move(versions)},
               {"damaged", std::move(damaged)}});
}

Answer taken(OnlineChangeService& service, const Call& call) {
  const bool sources = call.body.has("files");
  if (sources == call.body.has("container"))
    return refused(400, "H0094", "this brings no program",
                   "either 'container' with its 'name', or 'files' with the sources");
  result::Result<Candidate> candidate;
  if (sources) {
    candidate = service.take_sources(call.body.texts("files"));
  } else {
    auto bytes = access::from_base64(call.body.text("container"));
    if (!bytes)
      return refused(400, "H0094", "'container' is no base64", "the standard alphabet, with padding");
    candidate = service.take_container(call.body.text("name"), *std::move(bytes));
  }
  if (!candidate) {
    Answer answer = refused_with_severities(candidate.error());
    answer.target = call.body.text("name");
    return answer;
  }
  Answer answer = told({{"program", candidate->digest},
                        {"name", candidate->name},
                        {"bytes", candidate->bytes},
                        {"warnings", judged(candidate->warnings)}});
  answer.target = candidate->name;
  answer.after = candidate->digest;
  return answer;
}

Answer compared(OnlineChangeService& service, const Call& call) {
  const auto seen = service.compare(call.parameter("program"));
  return seen ? told(comparison_json(*seen)) : refused_with_severities(seen.error());
}

Answer changed(OnlineChangeService& service, const Call& call) {
  const auto done = service.change({.program = call.body.text("program"),
                                    .base = call.body.text("base"),
                                    .restart_charts = call.body.text("charts") == "restart",
                                    .user = call.who.user,
                                    .role = access::to_string(call.who.role),
                                    .address = call.who.address,
                                    .reason = call.body.text("reason")});
  Answer answer = done ? told(record_json(*done)) : refused(done.error());
  answer.target = done ? done->name : "";
  answer.before = call.body.text("base");
  answer.after = call.body.text("program");
  return answer;
}

template <typename Handler>
Route with(OnlineChangeService* service, Route route, Handler handler) {
  route.least = Role::Engineer;
  return with_service(service, std::move(route), no_change, std::move(handler));
}

}  // namespace

std::vector<Route> change_routes(const Services& services) {
  OnlineChangeService* service = services.changes;
  Route diff =
      reading_row("/api/change/diff", "change.diff",
                  "What would be different if a program took over from the one that runs", kComparison);
  diff.query = {{"program", "digest of a program that was brought, or of an earlier one"}};
  Route sources = reading_row("/api/change/sources", "change.sources",
                              "Sources of such a program, as far as its container has them", kSources);
  sources.query = diff.query;
  Route take =
      acting_row("POST", "/api/change/check", "change.check",
                 "Brings a program to look at: verified or compiled, and kept for a while", kCandidate);
  take.body = {"BringProgram", {kName, kContainer, kFiles}};
  take.most_body = kMostBody;
  take.audit = Audit::After;  // nothing happens
  take.lane = Lane::Runtime;
  Route act = acting_row("POST", "/api/change/apply", "change.apply",
                         "Has such a program take over from the one that runs, between two scans", kRecord);
  act.body = {"ChangeProgram", {kProgram, kBase, kCharts, kReason}};
  act.lane = Lane::Runtime;
  return {
      with(service,
           reading_row("/api/change", "change.state",
                       "Programs that can be brought back, and what became of the newest change", kState),
           [](OnlineChangeService& at, const Call&) { return state_of(at); }),
      with(service, std::move(diff), compared),
      with(service, std::move(sources),
           [](OnlineChangeService& at, const Call& call) { return at.sources(call.parameter("program")); }),
      with(service, std::move(take), taken), with(service, std::move(act), changed)};
}

}  // namespace stepwright::api
