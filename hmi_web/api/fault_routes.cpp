// Faults of a simulated plant: what it can have and what holds now, to set and to end.

#include <algorithm>
#include <nlohmann/json.hpp>

#include "hmi_web/api/cell_codes.h"
#include "hmi_web/api/routes.h"

namespace stepwright::api {
namespace {

using nlohmann::json;

const Field kName{.name = "name", .least = 1, .most = 64, .description = "a fault as the list names it"};
const Field kValue{
    .name = "value", .kind = Kind::Number, .least = -1e12, .most = 1e12, .description = "in its unit"};
const Field kReason{.name = "reason", .least = 3, .most = 200, .description = "why, for the audit trail"};

json to_json(const host::PlantFault& fault) {
  const bool known = fault.low != fault.high;
  return {{"name", fault.name},
          {"unit", fault.unit},
          {"meaning", fault.meaning},
          {"low", known ? json(fault.low) : json()},
          {"high", known ? json(fault.high) : json()},
          {"whole", fault.whole},
          {"value", fault.holds ? json(fault.value) : json()}};
}

std::string to_text(const json& document) {
  return document.dump(-1, ' ', false, json::error_handler_t::replace);
}

// The value that the fault has, as the audit trail shows it; empty: it does not hold.
std::string value_of(CellControl& cell, const std::string& name) {
  const auto faults = cell.faults();
  if (!faults) return {};
  const auto found = std::find_if(faults->begin(), faults->end(),
                                  [&](const host::PlantFault& each) { return each.name == name; });
  return found == faults->end() || !found->holds ? std::string() : json(found->value).dump();
}

Route row(const char* path, const char* name, const char* summary, Shape shape) {
  Route route = acting_row("POST", path, name, summary, R"({"type": "object", "required": ["name"],
    "properties": {"name": {"type": "string"}}})");
  route.least = Role::Engineer;
  route.lane = Lane::Runtime;
  route.body = std::move(shape);
  return route;
}

Answer done_or_not(CellControl& cell, const std::string& name, std::optional<double> value) {
  const std::string before = value_of(cell, name);
  const auto done = cell.set_fault(name, value);
  Answer answer = done ? Answer{.text = to_text({{"name", name}})} : refused(done.error());
  answer.target = name;
  answer.before = before;
  answer.after = value ? json(*value).dump() : "";
  return answer;
}

// Pages ask again and again: a runtime that does not answer just now is news for them, and no failure.
Answer without_answer(const result::Diagnostics& problems) {
  Answer answer = refused(problems);
  if (!nobody_answers(problems)) return answer;
  json document = json::parse(answer.text);
  document["answers"] = false;
  document["faults"] = json::array();
  return {.text = to_text(document)};
}

}  // namespace

std::vector<Route> fault_routes(const Services& services) {
  CellControl* cell = services.cell;
  Route list = reading_row("/api/faults", "fault.list",
                           "Faults of the simulated plant; value: null where one does not hold",
                           R"({"type": "object", "required": ["answers", "faults"], "properties": {
    "answers": {"type": "boolean"}, "problems": {"type": "array"}, "faults": {"type": "array", "items":
    {"type": "object", "required": ["name", "unit", "meaning", "low", "high", "whole", "value"], "properties": {
      "name": {"type": "string"}, "unit": {"type": "string"}, "meaning": {"type": "string"},
      "low": {"type": ["number", "null"]}, "high": {"type": ["number", "null"]}, "whole": {"type": "boolean"},
      "value": {"type": ["number", "null"]}}}}}})");
  list.handler = [cell](const Call&) {
    const auto faults = cell->faults();
    if (!faults) return without_answer(faults.error());
    json document = {{"answers", true}, {"faults", json::array()}};
    for (const host::PlantFault& fault : *faults) document["faults"].push_back(to_json(fault));
    return Answer{.text = to_text(document)};
  };
  Route set = row("/api/faults/set", "fault.set", "Makes a fault of the simulated plant hold",
                  {"SetFault", {kName, kValue, kReason}});
  set.handler = [cell](const Call& call) {
    return done_or_not(*cell, call.body.text("name"), call.body.number("value", 0.0));
  };
  Route clear = row("/api/faults/clear", "fault.clear", "Ends a fault of the simulated plant",
                    {"ClearFault", {kName, kReason}});
  clear.handler = [cell](const Call& call) {
    return done_or_not(*cell, call.body.text("name"), std::nullopt);
  };
  return {list, set, clear};
}

}  // namespace stepwright::api
