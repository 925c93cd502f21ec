#include "hmi_web/api/cell_figures.h"
#include "hmi_web/api/routes.h"

namespace stepwright::api {
namespace {

constexpr const char* kScan = R"({"type": "object", "required": ["runtimes"],
  "properties": {"runtimes": {"type": "array", "items": {"type": "object",
    "required": ["runtime", "own", "alive", "state", "tasks", "io", "dds"],
    "properties": {"runtime": {"type": "string"}, "own": {"type": "boolean"}, "alive": {"type": "boolean"},
      "state": {"type": "string"}, "tasks": {"type": "array", "items": {"type": "object"}},
      "io": {"type": ["object", "null"]}, "dds": {"type": "array", "items": {"type": "object"}}}}}}})";

}  // namespace

std::vector<Route> figure_routes(const Services& services) {
  Route route = reading_row(
      "/api/scan", "scan.read",
      "Tasks with their histograms, I/O, DDS and process of every runtime that is followed", kScan);
  route.handler = [figures = services.figures](const Call&) {
    if (figures != nullptr) return figures->scan();
    return refused(404, "H0063", "this server follows no runtime");
  };
  return {route};
}

}  // namespace stepwright::api
