#include "hmi_web/api/cell_monitor.h"
#include "hmi_web/api/cell_program.h"
#include "hmi_web/api/routes.h"

namespace stepwright::api {
namespace {

constexpr const char* kProgram =
    R"({"type": "object", "required": ["digest", "state", "instances", "document"],
  "properties": {"digest": {"type": "string"}, "state": {"enum": ["complete", "absent", "damaged"]},
    "instances": {"type": "array", "items": {"type": "object", "required": ["path", "pou"],
      "properties": {"path": {"type": "string"}, "pou": {"type": "string"}}}},
    "document": {"type": ["object", "null"]}}})";

constexpr const char* kLive =
    R"({"type": "object", "required": ["digest", "scan", "steps", "tags", "blocks"],
  "properties": {"digest": {"type": "string"}, "scan": {"type": "integer"},
    "steps": {"type": "array", "items": {"type": "integer"}}, "tags": {"type": "object"},
    "blocks": {"type": "object"}}})";
constexpr const char* kChart =
    R"({"type": "object", "required": ["digest", "width", "height", "exits", "steps", "transitions", "jumps",
    "lines", "doubles"],
  "properties": {"digest": {"type": "string"}, "width": {"type": "integer"}, "height": {"type": "integer"},
    "exits": {"type": "array", "items": {"type": "integer"}},
    "steps": {"type": "array", "items": {"type": "object"}},
    "transitions": {"type": "array", "items": {"type": "object"}},
    "jumps": {"type": "array", "items": {"type": "object"}},
    "lines": {"type": "array", "items": {"type": "array"}},
    "doubles": {"type": "array", "items": {"type": "array"}}}})";

using AskMonitor = Answer (CellMonitor::*)(const CellMonitor::Parameters&) const;

Route monitor_row(const CellMonitor* monitor, Route route, std::vector<Parameter> query, AskMonitor ask) {
  route.query = std::move(query);
  route.handler = [monitor, ask](const Call& call) {
    if (monitor != nullptr) return (monitor->*ask)(call.parameters);
    return refused(404, "H0066", "no program is known to this server");
  };
  return route;
}

}  // namespace

std::vector<Route> program_routes(const Services& services) {
  Route route =
      reading_row("/api/program", "program.read",
                  "Sources of the running program, as far as its container has them; with an ETag", kProgram);
  route.handler = [program = services.program](const Call&) {
    if (program != nullptr) return program->sources();
    return refused(404, "H0066", "no program is known to this server");
  };
  return {
      route,
      monitor_row(
          services.monitor,
          reading_row("/api/program/live", "program.live",
                      "What blocks of a sheet show in the newest scan, all of it of that scan", kLive),
          {{"sheet", "its number in the document"},
           {"instance", "path of the instance; empty: it has none"},
           {"blocks", "0-3,7: numbers of blocks in the sheet"},
           {"tags", "likewise: numbers of tags whose values are wanted"}},
          &CellMonitor::live),
      monitor_row(services.monitor,
                  reading_row("/api/chart", "program.chart",
                              "Where the steps, transitions and lines of a chart stand, in pixels", kChart),
                  {{"chart", "its name; all charts together without it"},
                   {"exits", "1: with the steps in which it ends when something goes wrong"},
                   {"shown", "3,7: of these steps those that are drawn in any case"}},
                  &CellMonitor::chart)};
}

}  // namespace stepwright::api
