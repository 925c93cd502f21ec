// Goals as people put them together: what a form needs, plans that are only looked at, and the start of a
// run.

#include <nlohmann/json.hpp>

#include "hmi_web/api/internal/supervisor_row.h"
#include "hmi_web/api/routes.h"

namespace stepwright::api {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxGoalBytes = 8'192;

// What a supervisor said, which comes over Fast DDS from anywhere: an object, nested no deeper than any that
// a supervisor writes, or nothing.
std::string checked(const std::string& document) {
  constexpr int kMaxDepth = 12;
  const auto shallow = [](int depth, json::parse_event_t, json&) { return depth < kMaxDepth; };
  const json value = json::parse(document, shallow, /*allow_exceptions=*/false);
  return value.is_object() ? value.dump(-1, ' ', false, json::error_handler_t::replace) : std::string();
}

Route document_row(CellControl* cell, const char* path, const char* name, const char* summary,
                   std::string (CellControl::*document)()) {
  Route route =
      reading_row(path, name, summary, R"({"type": "object", "description": "supervisor/doc/goals.md"})");
  route.handler = [cell, document](const Call&) {
    std::string text = checked((cell->*document)());
    if (!text.empty()) return Answer{.status = 200, .text = std::move(text)};
    return refused(
        404, "H0064", "no supervisor has said anything of goals",
        "is the supervisor of the cell running and of this version, and does its planner take goals?");
  };
  return route;
}

Field goal_field(bool required) {
  Field field = text_field("goal", kMaxGoalBytes, kGoalText);
  field.required = required;
  return field;
}

Field id_field(bool required) {
  Field field = text_field("id", 64, "of the question; comes back with its answer");
  field.required = required;
  return field;
}

// With what of the goal and of the id the body has.
json request_of(const char* kind, const Body& body) {
  json request = {{"request", kind}};
  for (const char* name : {"goal", "id"}) {
    if (body.has(name)) request[name] = body.text(name);
  }
  return request;
}

// A start puts another program in place, with which every force would end unseen.
Route start_row(CellControl* cell, ForceService* forces) {
  Route route = supervisor_row(cell, "/api/plan/start", "plan.start",
                               "Starts what waits for an operator, or another run after one that has ended",
                               {"Start", {goal_field(false)}},
                               [](const Body& body) { return request_of("start", body); });
  route.handler = [ask = route.handler, forces](const Call& call) {
    const std::vector<std::string> forced = forces != nullptr ? forces->names() : std::vector<std::string>();
    if (forced.empty()) return ask(call);
    std::string names = forced.front();
    for (std::size_t i = 1; i < forced.size(); ++i) names += ", " + forced[i];
    return refused(409, "H0065", names + (forced.size() == 1 ? " is forced" : " are forced"),
                   "release what is forced before the plant is started");
  };
  return route;
}

}  // namespace

std::vector<Route> goal_routes(const Services& services) {
  CellControl* cell = services.cell;
  return {
      document_row(cell, "/api/plan/goal-form", "goal.form", "What goals of this cell can be made of",
                   &CellControl::goal_form),
      document_row(cell, "/api/plan/outlook", "plan.outlook",
                   "What holds now, the goal, and what the newest what-if has come to",
                   &CellControl::outlook),
      supervisor_row(cell, "/api/plan/what-if", "plan.what_if",
                     "Plans for a goal from where the plant is, and does not run it",
                     {"WhatIf", {goal_field(true), id_field(true)}},
                     [](const Body& body) { return request_of("what_if", body); }),
      supervisor_row(cell, "/api/plan/what-if/cancel", "plan.cancel_what_if", "Ends the search of a what-if",
                     {"CancelWhatIf", {id_field(false)}},
                     [](const Body& body) { return request_of("cancel_what_if", body); }),
      start_row(cell, services.forces),
  };
}

}  // namespace stepwright::api
