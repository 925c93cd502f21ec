#include <nlohmann/json.hpp>

#include "hmi_web/api/cell_notifications.h"
#include "hmi_web/api/internal/service_row.h"
#include "hmi_web/api/routes.h"

namespace stepwright::api {
namespace {

using nlohmann::json;

constexpr const char* kList =
    R"({"type": "object", "required": ["notifications"], "properties": {"notifications":
  {"type": "array", "items": {"type": "object", "required": ["name", "kind", "to", "priority", "delay_s", "repeat_s",
    "sent", "tests_done", "sent_ms", "failed_ms", "problem"]}}}})";
constexpr const char* kAsked =
    R"({"type": "object", "required": ["name"], "properties": {"name": {"type": "string"}}})";

json time_of(std::int64_t ms) {
  return ms == 0 ? json() : json(ms);
}

Answer list_of(const CellNotifications* notifications) {
  json list = json::array();
  if (notifications != nullptr) {
    for (const NotificationStatus& each : notifications->status()) {
      list.push_back({{"name", each.channel},
                      {"kind", each.kind},
                      {"to", each.to},
                      {"priority", each.priority},
                      {"delay_s", each.delay.count()},
                      {"repeat_s", each.repeat.count()},
                      {"sent", each.sent},
                      {"tests_done", each.tests_done},
                      {"sent_ms", time_of(each.sent_ms)},
                      {"failed_ms", time_of(each.failed_ms)},
                      {"problem", each.problem}});
    }
  }
  return Answer{
      .text = json{{"notifications", std::move(list)}}.dump(-1, ' ', false, json::error_handler_t::replace)};
}

Answer no_channels() {
  return refused(404, "H0084", "this cell notifies nobody", "[[notify]] in the cell's configuration");
}

}  // namespace

std::vector<Route> notify_routes(const Services& services) {
  Route list = reading_row("/api/notifications", "notification.list",
                           "Who is told of alarms that nobody acknowledges, and whether it arrives", kList);
  list.least = Role::Operator;
  list.handler = [at = services.notifications](const Call&) { return list_of(at); };
  Route test = acting_row("POST", "/api/notifications/test", "notification.test",
                          "Sends a test soon; the list tells whether it has arrived", kAsked);
  test.least = Role::Operator;
  test.body = {"TestNotification",
               {{.name = "name", .least = 1, .most = 64, .description = "of the notification"}}};
  return {std::move(list), with_service(services.notifications, std::move(test), no_channels,
                                        [](CellNotifications& at, const Call& call) {
                                          const std::string& name = call.body.text("name");
                                          const auto asked = at.test(name, call.who.user);
                                          if (!asked) return refused(404, asked.error());
                                          return Answer{.text = json{{"name", name}}.dump()};
                                        })};
}

}  // namespace stepwright::api
