#include <nlohmann/json.hpp>

#include "hmi_web/api/internal/supervisor_row.h"
#include "hmi_web/api/routes.h"

namespace stepwright::api {
namespace {

using nlohmann::json;

Route stop_row(CellControl* cell) {
  Route route = supervisor_row(cell, "/api/runtime/stop", "runtime.stop",
                               "Stops the program; outputs go to their safe state", {"Stop", {}}, {});
  route.body.fields.front().required = true;
  route.body.fields.front().least = 1;
  route.body.fields.front().most = 160;  // the name of the user goes before it
  route.handler = [cell](const Call& call) {
    const std::string why = call.who.user + ": " + call.body.text("reason");
    return accepted(cell->stop_runtime(why), "", "stopped");
  };
  return stopping(std::move(route));
}

// Without corners: a place that the supervisor knows by its name, if its planner has such places.
json block_of(const Body& body) {
  json request = {{"request", "block"}, {"name", body.text("name")}};
  if (!body.has("corners_m")) return request;
  json& corners = request["corners_m"] = json::array();
  for (const Point& point : body.points("corners_m")) corners.push_back({point.x, point.y});
  return request;
}

std::vector<Route> fleet_rows(CellControl* cell) {
  const Field amount{.name = "amount",
                     .kind = Kind::Number,
                     .required = false,
                     .least = 1,
                     .most = 1'000'000,
                     .whole = true,
                     .description = "how many loads"};
  const Field corners{.name = "corners_m",
                      .kind = Kind::Points,
                      .required = false,
                      .least = 3,
                      .most = 64,
                      .description = "of the area, m; without them `name` is a place of a train's floor"};
  return {
      supervisor_row(
          cell, "/api/fleet/order", "fleet.order",
          "A new load for the fleet, or another amount of a known one",
          {"FleetOrder",
           {text_field("name", 128, "of the order"), text_field("from", 128, "a location of the problem"),
            text_field("to", 128, "a location of the problem"), amount}},
          [](const Body& body) {
            return json{{"request", "order"},
                        {"name", body.text("name")},
                        {"from", body.text("from")},
                        {"to", body.text("to")},
                        {"amount", static_cast<std::uint32_t>(body.number("amount", 1))}};
          }),
      supervisor_row(cell, "/api/fleet/block", "fleet.block",
                     "Nobody is to drive there until it is free again",
                     {"FleetBlock", {text_field("name", 128, "of the place"), corners}}, block_of),
      supervisor_row(cell, "/api/fleet/unblock", "fleet.unblock", "The place is free again",
                     {"FleetUnblock", {text_field("name", 128, "of the place")}},
                     [](const Body& body) {
                       return json{{"request", "unblock"}, {"name", body.text("name")}};
                     }),
      supervisor_row(cell, "/api/fleet/return", "fleet.return",
                     "A vehicle that stopped by itself takes part again",
                     {"FleetReturn", {text_field("vehicle", 128, "its name")}},
                     [](const Body& body) {
                       return json{{"request", "return"}, {"vehicle", body.text("vehicle")}};
                     }),
  };
}

}  // namespace

std::vector<Route> plan_routes(const Services& services) {
  CellControl* cell = services.cell;
  const Field value{.name = "value",
                    .kind = Kind::Number,
                    .least = -1e12,
                    .most = 1e12,
                    .description = "what it is from now on"};
  std::vector<Route> rows = {
      stop_row(cell),
      stopping(supervisor_row(cell, "/api/plan/abort", "plan.abort",
                              "Stops the plant safely at the next decision and ends the run", {"Abort", {}},
                              [](const Body&) {
                                return json{{"request", "abort"}};
                              })),
      stopping(supervisor_row(cell, "/api/plan/hold", "plan.hold",
                              "Brings the plant to rest at the next decision, until it is resumed",
                              {"Hold", {}},
                              [](const Body&) {
                                return json{{"request", "hold"}};
                              })),
      supervisor_row(cell, "/api/plan/resume", "plan.resume",
                     "Goes on with the plan, or with another one from where the plant is", {"Resume", {}},
                     [](const Body&) {
                       return json{{"request", "resume"}};
                     }),
      supervisor_row(cell, "/api/plan/goal", "plan.goal", "Puts another goal in place of the one so far",
                     {"NewGoal", {text_field("goal", 8'192, kGoalText)}},
                     [](const Body& body) {
                       return json{{"request", "goal"}, {"goal", body.text("goal")}};
                     }),
      supervisor_row(cell, "/api/plan/change", "plan.change",
                     "Says that something that the plant does not decide has changed",
                     {"Change", {text_field("fluent", 512, "for example (demand c1)"), value}},
                     [](const Body& body) {
                       return json{{"request", "change"},
                                   {"fluent", body.text("fluent")},
                                   {"value", body.number("value")}};
                     }),
  };
  for (Route& each : fleet_rows(cell)) rows.push_back(std::move(each));
  return rows;
}

}  // namespace stepwright::api
