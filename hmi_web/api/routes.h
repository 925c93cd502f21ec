#pragma once

// All rows of the route table. What a row refers to outlives the table.
//
//   const RouteTable table(all_routes({&control, &audit, &forces, &cell}));
//   print(openapi(table, "0.1.0"));
//
// Pure but for what the handlers do. With services that are null the rows are there, for their description,
// and their handlers must not be called.

#include <string>
#include <vector>

#include "hmi_web/access/access_control.h"
#include "hmi_web/access/audit_log.h"
#include "hmi_web/api/cell_control.h"
#include "hmi_web/api/cell_figures.h"
#include "hmi_web/api/cell_monitor.h"
#include "hmi_web/api/cell_notifications.h"
#include "hmi_web/api/cell_program.h"
#include "hmi_web/api/cell_records.h"
#include "hmi_web/api/force_service.h"
#include "hmi_web/api/online_change_service.h"
#include "hmi_web/api/recipe_service.h"
#include "hmi_web/api/route.h"
#include "hmi_web/api/screen_service.h"
#include "hmi_web/trends/trend_store.h"

namespace stepwright::api {

struct Services {
  access::AccessControl* control = nullptr;
  access::AuditLog* audit = nullptr;
  ForceService* forces = nullptr;
  CellControl* cell = nullptr;
  CellRecords* records = nullptr;          // null also where a server keeps none: its rows answer 404 then
  RecipeService* recipes = nullptr;        // likewise
  CellFigures* figures = nullptr;          // null also where no runtime is followed: 404
  const std::string* drawing = nullptr;    // an SVG that may be shown; null: the plant is drawn by the page
  CellProgram* program = nullptr;          // null also where no sources are served: 404
  OnlineChangeService* changes = nullptr;  // null also where no program is changed: 404
  CellMonitor* monitor = nullptr;          // null also where no program is watched: 404
  trends::TrendStore* trends = nullptr;    // null also where no history is kept: 404
  CellNotifications* notifications = nullptr;  // null also where nobody is told of alarms
  std::vector<std::string> wall = {};          // panels of a display on the wall
  ScreenService* screens = nullptr;            // null also where no screens are kept: 404
};

// Routes that the server itself answers: files of the page, the WebSocket, metrics.
std::vector<Route> server_routes();
// Logging in and out, the own password, claiming the administrator.
std::vector<Route> session_routes(const Services& services);
// For administrators.
std::vector<Route> user_routes(const Services& services);
std::vector<Route> audit_routes(const Services& services);
// Operators' requests to the supervisor.
std::vector<Route> plan_routes(const Services& services);
// Vocabulary of goals, plans for inspection only (what-if), and the start of a run.
std::vector<Route> goal_routes(const Services& services);
// Writing and forcing, for engineers.
std::vector<Route> tag_routes(const Services& services);
std::vector<Route> fault_routes(const Services& services);
// History, alarms and their journal, for viewers.
std::vector<Route> record_routes(const Services& services);
// Groups of trends: looking for viewers, saving and removing for operators.
std::vector<Route> trend_routes(const Services& services);
// Who is told of alarms, and tests of that; for operators.
std::vector<Route> notify_routes(const Services& services);
// Actions of operators and engineers on alarms.
std::vector<Route> alarm_routes(const Services& services);
// Recipes: looking for viewers, loading for operators, saving and removing for engineers.
std::vector<Route> recipe_routes(const Services& services);
// The plant as somebody has drawn it, for viewers.
std::vector<Route> drawing_routes(const Services& services);
// Screens: looking for those of their role, acting with their parts for operators, drawing for engineers.
std::vector<Route> screen_routes(const Services& services);
// How the runtimes are, for viewers.
std::vector<Route> figure_routes(const Services& services);
// The sources of the running program, and what it does with them, for viewers.
std::vector<Route> program_routes(const Services& services);
// Programs that take over from the one that runs, and earlier ones that come back; for engineers.
std::vector<Route> change_routes(const Services& services);
// H0062: of a server that keeps nothing.
Answer no_records();

std::vector<Route> all_routes(const Services& services);

}  // namespace stepwright::api
