#include "hmi_web/api/routes.h"

namespace stepwright::api {

std::vector<Route> drawing_routes(const Services& services) {
  Route route = reading_row("/api/drawing", "drawing.read",
                            "The plant as somebody has drawn it, with the bindings of its elements",
                            R"({"type": "string"})");
  route.lane = Lane::Quick;
  route.answer_type = "image/svg+xml";
  route.handler = [drawing = services.drawing](const Call&) {
    if (drawing != nullptr) return Answer{.text = *drawing, .content_type = "image/svg+xml"};
    return refused(404, "H0067", "this server has no drawing of the plant",
                   "[hmi] drawing = \"plant.svg\" in the cell's configuration");
  };
  return {route};
}

}  // namespace stepwright::api
