#include <charconv>
#include <nlohmann/json.hpp>

#include "hmi_web/api/internal/problems_json.h"
#include "hmi_web/api/internal/service_row.h"
#include "hmi_web/api/routes.h"
#include "hmi_web/api/screen_service.h"
#include "hmi_web/screens/codes.h"

namespace stepwright::api {
namespace {

using nlohmann::json;
using screens::Screen;
using screens::Version;

constexpr std::size_t kMostBody = 2 * drawing::kLargestFile + 65'536;  // quotes are escaped

const Field kSvg{.name = "svg",
                 .least = 1,
                 .most = static_cast<double>(drawing::kLargestFile),
                 .description = "the screen (hmi_web/doc/screens.md)"};
const Field kVersion{.name = "version",
                     .kind = Kind::Number,
                     .most = 999'999,
                     .whole = true,
                     .description = "the version that was changed; 0 of a new screen"};
const Field kComment{.name = "comment",
                     .required = false,
                     .most = static_cast<double>(screens::kLongestComment),
                     .description = "what is different"};
const Field kStart{.name = "screen",
                   .most = screens::kLongestName,
                   .description = "the name of a screen; empty: none any more"};
const Field kStartRole{.name = "role",
                       .required = false,
                       .choices = {screens::kStartRoles.begin(), screens::kStartRoles.end()},
                       .description = "whose start; without it: everybody's who has none of his own"};
const Field kPart{.name = "part", .least = 1, .most = 40, .description = "data-key of the part"};
const Field kValue{.name = "value",
                   .most = 64,
                   .description = "a literal of IEC 61131-3 that the part takes; start or stop of a pair"};
const Field kOnce{.name = "once",
                  .least = 8,
                  .most = 64,
                  .description = "a name for this deed by chance: asked twice, it is done once"};
const Field kConfirmed{.name = "confirmed",
                       .kind = Kind::Boolean,
                       .required = false,
                       .description = "the question of the part was answered with yes"};

const Field kWrites{.name = "writes",
                    .required = false,
                    .most = 512,
                    .description =
                        "the variable that the part wrote when it was shown: if it writes another one "
                        "by now, nothing is written"};
const Field kQuestion{.name = "question",
                      .required = false,
                      .most = 512,
                      .description = "likewise, the question that it asked"};

constexpr const char* kScreens = R"({"type": "object", "required": ["screens", "start"], "properties": {
  "start": {"type": "string"}, "starts": {"type": "object"}, "screens": {"type": "array", "items": {"type": "object",
    "required": ["name", "version", "saved_by", "saved_ms", "comment", "least", "symbol", "removed"]}}}})";
constexpr const char* kScreen = R"({"type": "object", "required": ["name", "version", "svg"], "properties": {
  "name": {"type": "string"}, "version": {"type": "integer"}, "svg": {"type": "string"}}})";
constexpr const char* kHistory = R"({"type": "object", "required": ["name", "current", "versions"],
  "properties": {"name": {"type": "string"}, "current": {"type": "integer"},
    "versions": {"type": "array", "items": {"type": "object"}}}})";
constexpr const char* kSaved = R"({"type": "object", "required": ["name", "version"], "properties": {
  "name": {"type": "string"}, "version": {"type": "integer"},
  "warnings": {"type": "array", "items": {"type": "object", "required": ["code", "message"]}}}})";
constexpr const char* kCheckedScreen = R"({"type": "object", "required": ["svg", "warnings"], "properties": {
  "svg": {"type": "string"},
  "warnings": {"type": "array", "items": {"type": "object", "required": ["code", "message"]}}}})";
constexpr const char* kWritten = R"({"type": "object", "required": ["name", "value"], "properties": {
  "name": {"type": "string"}, "value": {"type": "string"}}})";

Answer no_screens() {
  return refused(404, screens::kNoSuchScreen, "this server has no screens", "[hmi] screens_dir");
}
// Pages ask by themselves: there is nothing to see.
Answer empty_list() {
  return Answer{.text = R"({"screens": [], "start": ""})"};
}
Answer no_such(const std::string& name) {
  return refused(404, screens::kNoSuchScreen,
                 "there is no screen '" + name.substr(0, screens::kLongestName) + "'",
                 "somebody may have removed it meanwhile, or it is for another role");
}

Answer answer_of(const json& document) {
  return Answer{.text = document.dump(-1, ' ', false, json::error_handler_t::replace)};
}

json described(const Version& version) {
  const auto saved =
      std::chrono::duration_cast<std::chrono::milliseconds>(version.saved.time_since_epoch()).count();
  return {{"version", version.number},   {"based_on", version.based_on}, {"saved_by", version.saved_by},
          {"saved_ms", saved},           {"comment", version.comment},   {"least", version.least},
          {"symbol", version.is_symbol}, {"aside", version.aside},       {"removed", version.removed}};
}

// Who chooses them sees those of all roles; "everybody" is who has none of his own.
json starts_of(const screens::ScreenStore& store) {
  json starts = {{"everybody", store.start()}};
  for (const char* role : screens::kStartRoles) starts[role] = store.start(role);
  return starts;
}

Answer list_of(ScreenService& service, const Call& call) {
  json list = json::array();
  for (const Screen& screen : service.list(call.who.role)) {
    const Version* now = screen.current();
    if (now == nullptr) continue;
    json entry = described(*now);
    entry["name"] = screen.name;
    list.push_back(std::move(entry));
  }
  // Other pages look whether something is new by asking.
  json document = {{"screens", std::move(list)}, {"start", service.start_of(call.who.role)}};
  if (call.who.role >= Role::Engineer) document["starts"] = starts_of(service.store());
  return answer_of(document);
}

// Of the query; the newest without one. Nothing: it is no number.
std::optional<std::uint32_t> version_of(const Screen& screen, const std::string& text) {
  if (text.empty()) return screen.current() == nullptr ? 0 : screen.current()->number;
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

Answer one_of(ScreenService& service, const Call& call, bool as_file) {
  const std::string& name = call.parameter("name");
  const auto screen = service.find(name, call.who.role);
  if (!screen) return no_such(name);
  const auto version = version_of(*screen, call.parameter("version"));
  // What lies aside or was replaced may be for another role.
  const bool newest = call.parameter("version").empty();
  if (!version || (!newest && call.who.role < Role::Engineer))
    return refused(version ? 403 : 400, kPartOfOtherRole,
                   "engineers look at earlier versions, by their number");
  const auto drawn = service.store().read(name, *version);
  if (!drawn) return refused(drawn.error());
  if (as_file) return Answer{.text = drawn->svg, .content_type = "image/svg+xml", .file_name = name + ".svg"};
  return answer_of({{"name", name}, {"version", *version}, {"svg", drawn->svg}});
}

Answer history_of(ScreenService& service, const Call& call) {
  const std::string& name = call.parameter("name");
  const auto screen = service.find(name, call.who.role);
  if (!screen) return no_such(name);
  json list = json::array();
  for (auto each = screen->versions.rbegin(); each != screen->versions.rend(); ++each)
    list.push_back(described(*each));
  const Version* now = screen->current();
  return answer_of(
      {{"name", name}, {"current", now == nullptr ? 0 : now->number}, {"versions", std::move(list)}});
}

// Both versions are kept: the refusal says which they are.
Answer conflict(const Screen& screen, const Version& mine) {
  const Version* other = screen.current();
  Answer answer = refused(409, screens::kSavedMeanwhile,
                          (other->saved_by.empty() ? "somebody" : other->saved_by) + " has saved version " +
                              std::to_string(other->number) + " of '" + screen.name + "' meanwhile",
                          "yours is kept as version " + std::to_string(mine.number) +
                              " and not shown: save it again on top of theirs, or go on with theirs");
  json document = json::parse(answer.text);
  document["current"] = described(*other);
  document["kept"] = mine.number;
  answer.text = document.dump(-1, ' ', false, json::error_handler_t::replace);
  return answer;
}

std::string told(const Version& version) {
  return version.number == 0 ? "" : "version " + std::to_string(version.number);
}

Answer save(ScreenService& service, const Call& call) {
  const std::string& name = call.parameter("name");
  const auto before = service.store().find(name);
  const auto saved =
      service.store().save({.name = name,
                            .svg = call.body.text("svg"),
                            .based_on = static_cast<std::uint32_t>(call.body.number("version")),
                            .user = call.who.user,
                            .comment = call.body.text("comment")},
                           service.now());
  Answer answer;
  if (!saved)
    answer = refused(saved.error());
  else if (saved->aside)
    answer = conflict(*service.store().find(name), *saved);
  else
    answer = answer_of({{"name", name},
                        {"version", saved->number},
                        {"warnings", problems_json(service.doubts_of(name, call.body.text("svg")))}});
  answer.target = name;
  if (before && before->current() != nullptr) answer.before = told(*before->current());
  if (saved) answer.after = told(*saved) + (saved->aside ? " aside" : "");
  return answer;
}

// Of a file that somebody goes on drawing: nothing is kept.
Answer check(ScreenService& service, const Call& call) {
  const std::string& text = call.body.text("svg");
  auto drawn = drawing::read_drawing("screen.svg", text);
  if (!drawn) return refused(400, drawn.error());
  const auto doubts = service.doubts_of("screen", text);
  return answer_of({{"svg", std::move(drawn->svg)}, {"warnings", problems_json(doubts)}});
}

Answer remove(ScreenService& service, const Call& call) {
  const std::string& name = call.parameter("name");
  const auto screen = service.find(name, call.who.role);
  const auto version = screen ? version_of(*screen, call.parameter("version")) : std::nullopt;
  if (!version) return no_such(name);
  const auto removed = service.store().remove(name, *version, call.who.user, service.now());
  Answer answer =
      removed ? answer_of({{"name", name}, {"version", removed->number}}) : refused(removed.error());
  answer.target = name;
  answer.before = "version " + std::to_string(*version);
  return answer;
}

Answer set_start(ScreenService& service, const Call& call) {
  const std::string name = call.body.text("screen");
  const std::string role = call.body.text("role");
  const std::string before = service.store().start(role);
  const auto done = service.store().set_start(name, role);
  Answer answer = done ? answer_of({{"name", name}, {"version", 0}}) : refused(done.error());
  answer.target = role.empty() ? "everybody" : role;
  answer.before = before;
  answer.after = name;
  return answer;
}

std::optional<std::string> given(const Body& body, const char* name) {
  return body.has(name) ? std::optional(body.text(name)) : std::nullopt;
}

Answer write(ScreenService& service, const Call& call) {
  const std::string& screen = call.parameter("name");
  const auto written = service.write({.screen = screen,
                                      .part = call.body.text("part"),
                                      .value = call.body.text("value"),
                                      .once = call.who.user + " " + call.body.text("once"),
                                      .confirmed = call.body.boolean("confirmed"),
                                      .role = call.who.role,
                                      .writes = given(call.body, "writes"),
                                      .question = given(call.body, "question")});
  if (!written) {
    Answer answer = refused(written.error());
    answer.target = screen + ": " + call.body.text("part");
    answer.after = call.body.text("value");
    return answer;
  }
  Answer answer = answer_of({{"name", written->variable}, {"value", written->after}});
  answer.target = written->variable + " (" + screen + ": " + call.body.text("part") + ")";
  answer.before = written->before;
  answer.after = written->after;
  return answer;
}

Route engineers(Route route, Shape body = {}) {
  route.least = Role::Engineer;
  route.body = std::move(body);
  return route;
}

}  // namespace

std::vector<Route> screen_routes(const Services& services) {
  ScreenService* service = services.screens;
  const auto with = [&](Route route, auto handler) {
    return with_service(service, std::move(route), no_screens, std::move(handler));
  };
  const std::vector<Parameter> version = {{"version", "its number; without it: the newest"}};
  Route one = reading_row("/api/screens/{name}", "screen.read", "One screen", kScreen);
  one.query = version;
  Route file = reading_row("/api/screens/{name}/export.svg", "screen.export", "One screen as a file",
                           R"({"type": "string"})");
  file.answer_type = "image/svg+xml";
  file.query = version;
  Route saving = engineers(
      acting_row("PUT", "/api/screens/{name}", "screen.save", "Saves a screen as a new version", kSaved),
      {"SaveScreen", {kSvg, kVersion, kComment}});
  saving.most_body = kMostBody;
  Route checking =
      engineers(acting_row("POST", "/api/screen-check", "screen.check",
                           "A drawing as a screen would keep it; nothing is saved", kCheckedScreen),
                {"CheckScreen", {kSvg}});
  checking.most_body = kMostBody;
  Route removing = engineers(acting_row("DELETE", "/api/screens/{name}", "screen.remove",
                                        "Removes a screen; its versions are kept", kSaved));
  removing.query = {{"version", "the version that was looked at"}};
  Route writing = acting_row("POST", "/api/screens/{name}/write", "screen.write",
                             "Writes what a part of a screen may write, once", kWritten);
  writing.least = Role::Operator;
  writing.lane = Lane::Runtime;
  writing.body = {"WritePart", {kPart, kValue, kOnce, kConfirmed, kWrites, kQuestion}};
  return {
      with_service(
          service,
          reading_row("/api/screens", "screen.list", "The screens that the caller may see", kScreens),
          empty_list, [](ScreenService& at, const Call& call) { return list_of(at, call); }),
      with(std::move(one), [](ScreenService& at, const Call& call) { return one_of(at, call, false); }),
      with(std::move(file), [](ScreenService& at, const Call& call) { return one_of(at, call, true); }),
      with(engineers(reading_row("/api/screens/{name}/versions", "screen.versions",
                                 "Who has saved a screen, and when", kHistory)),
           [](ScreenService& at, const Call& call) { return history_of(at, call); }),
      with(std::move(saving), [](ScreenService& at, const Call& call) { return save(at, call); }),
      with(std::move(checking), [](ScreenService& at, const Call& call) { return check(at, call); }),
      with(std::move(removing), [](ScreenService& at, const Call& call) { return remove(at, call); }),
      with(engineers(acting_row("PUT", "/api/screen-start", "screen.start", "The screen that pages open with",
                                kSaved),
                     {"StartScreen", {kStart, kStartRole}}),
           [](ScreenService& at, const Call& call) { return set_start(at, call); }),
      with(std::move(writing), [](ScreenService& at, const Call& call) { return write(at, call); }),
  };
}

}  // namespace stepwright::api
