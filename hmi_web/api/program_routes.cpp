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

}  // namespace

std::vector<Route> program_routes(const Services& services) {
  Route route =
      reading_row("/api/program", "program.read",
                  "Sources of the running program, as far as its container has them; with an ETag", kProgram);
  route.handler = [program = services.program](const Call&) {
    if (program != nullptr) return program->sources();
    return refused(404, "H0066", "no program is known to this server");
  };
  return {route};
}

}  // namespace stepwright::api
