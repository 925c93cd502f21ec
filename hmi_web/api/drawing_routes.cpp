#include "hmi_web/api/routes.h"

namespace stepwright::api {

std::vector<Route> drawing_routes(const Services& services) {
  Route route;
  route.method = "GET";
  route.path = "/api/drawing";
  route.name = "drawing.read";
  route.least = Role::Viewer;
  route.csrf = false;
  route.summary = "The plant as somebody has drawn it, with the bindings of its elements";
  route.answer = R"({"type": "string"})";
  route.answer_type = "image/svg+xml";
  route.handler = [drawing = services.drawing](const Call&) {
    if (drawing != nullptr) return Answer{.text = *drawing, .content_type = "image/svg+xml"};
    return refused(404, "H0067", "this server has no drawing of the plant",
                   "[hmi] drawing = \"plant.svg\" in the cell's configuration");
  };
  return {route};
}

}  // namespace stepwright::api
