#include "hmi_web/api/routes.h"

namespace stepwright::api {

std::vector<Route> server_routes() {
  const auto row = [](const char* path, const char* name, Role least, const char* summary, const char* type) {
    Route route;
    route.method = "GET";
    route.path = path;
    route.name = name;
    route.least = least;
    route.csrf = false;
    route.lane = Lane::Server;
    route.summary = summary;
    route.answer = R"({"type": "string"})";
    route.answer_type = type;
    return route;
  };
  std::vector<Route> rows = {
      row("/", "page.open", Role::None, "The page", "text/html"),
      row("/{file}", "page.file", Role::None, "A file of the page", "*/*"),
      row("/assets/{file}", "page.asset", Role::None, "A file of the page", "*/*"),
      row("/metrics", "metrics.read", Role::None, "Figures of runtimes for Prometheus", "text/plain"),
      row("/live", "live.open", Role::Viewer,
          "WebSocket with everything that the page shows; with a session the CSRF token is offered as the "
          "subprotocol csrf.TOKEN",
          "text/plain"),
  };
  rows.back().csrf = true;
  return rows;
}

std::vector<Route> all_routes(const Services& services) {
  std::vector<Route> rows = server_routes();
  for (auto part :
       {session_routes(services), user_routes(services), audit_routes(services), plan_routes(services),
        goal_routes(services), tag_routes(services), fault_routes(services), record_routes(services),
        alarm_routes(services), trend_routes(services), notify_routes(services), recipe_routes(services),
        figure_routes(services), drawing_routes(services), program_routes(services), change_routes(services),
        screen_routes(services)}) {
    for (Route& row : part) rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace stepwright::api
