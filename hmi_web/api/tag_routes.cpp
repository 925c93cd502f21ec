#include <nlohmann/json.hpp>

#include "hmi_web/api/routes.h"

namespace stepwright::api {
namespace {

using nlohmann::json;

const Field kName{
    .name = "name", .least = 1, .most = 512, .description = "path of a variable, or a direct address"};
const Field kValue{
    .name = "value", .least = 1, .most = 64, .description = "a literal of IEC 61131-3: TRUE, 16#FF, T#2s"};
const Field kText{.name = "value",
                  .least = 1,
                  .most = 1'024,
                  .description = "a literal of IEC 61131-3; of a STRING also its text without quotes"};
const Field kReason{.name = "reason", .least = 3, .most = 200, .description = "why, for the audit trail"};
const Field kMinutes{.name = "minutes",
                     .kind = Kind::Number,
                     .required = false,
                     .least = 1,
                     .most = 480,
                     .whole = true,
                     .description = "after which it is released by itself (15)"};

Route row(const char* path, const char* name, const char* summary, Shape shape) {
  Route route = acting_row("POST", path, name, summary, R"({"type": "object", "required": ["name", "value"],
    "properties": {"name": {"type": "string"}, "value": {"type": "string"}}})");
  route.least = Role::Engineer;
  route.lane = Lane::Runtime;
  route.body = std::move(shape);
  return route;
}

// The answer to an action with a value of the program.
Answer tagged(const std::string& name, const std::string& before, const std::string& after) {
  Answer answer;
  answer.text = json{{"name", name}, {"value", after}}.dump(-1, ' ', false, json::error_handler_t::replace);
  answer.target = name;
  answer.before = before;
  answer.after = after;
  return answer;
}

Answer failed(const result::Diagnostics& problems, const std::string& name, const std::string& before,
              const std::string& asked) {
  Answer answer = refused(problems);
  answer.target = name;
  answer.before = before;
  answer.after = asked;
  return answer;
}

}  // namespace

std::vector<Route> tag_routes(const Services& services) {
  CellControl* cell = services.cell;
  ForceService* forces = services.forces;
  Route list = reading_row("/api/forces", "tag.forces",
                           "What is forced in the runtime, and of this server's forces until when",
                           R"({"type": "object", "required": ["forces"],
    "properties": {"forces": {"type": "array", "items": {"type": "object"}}}})");
  list.lane = Lane::Quick;
  list.handler = [forces](const Call&) { return Answer{.text = forces->json()}; };

  Route write = row("/api/tags/write", "tag.write", "Writes a value once; the program may change it again",
                    {"WriteTag", {kName, kText, kReason}});
  write.handler = [cell](const Call& call) {
    const std::string& name = call.body.text("name");
    if (auto there = cell->reach(); !there) return failed(there.error(), name, "", call.body.text("value"));
    const std::string before = cell->read(name).value_or("");
    const auto done = cell->write(name, call.body.text("value"));
    return done ? tagged(name, before, *done) : failed(done.error(), name, before, call.body.text("value"));
  };
  Route force = row("/api/tags/force", "tag.force", "Holds a variable at a value for a while",
                    {"ForceTag", {kName, kValue, kReason, kMinutes}});
  force.handler = [cell, forces](const Call& call) {
    const std::string& name = call.body.text("name");
    if (auto there = cell->reach(); !there) return failed(there.error(), name, "", call.body.text("value"));
    const std::string before = cell->read(name).value_or("");
    const auto minutes = std::chrono::minutes(static_cast<int>(call.body.number("minutes", 15)));
    const auto done =
        forces->force({name, call.body.text("value"), minutes, call.who.user, call.body.text("reason")});
    return done ? tagged(name, before, done->value)
                : failed(done.error(), name, before, call.body.text("value"));
  };
  Route unforce = row("/api/tags/unforce", "tag.unforce", "Releases a variable that is forced",
                      {"UnforceTag", {kName, kReason}});
  unforce.handler = [cell, forces](const Call& call) {
    const std::string& name = call.body.text("name");
    if (auto there = cell->reach(); !there) return failed(there.error(), name, "", "");
    const std::string before = cell->read(name).value_or("");
    const auto done = forces->unforce(name);
    return done ? tagged(name, before, "") : failed(done.error(), name, before, "");
  };
  return {list, write, force, unforce};
}

}  // namespace stepwright::api
