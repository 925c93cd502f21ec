#pragma once

// Access control between the page's server and the cell: users, audit trail, forces, recipes, screens, route
// table and guard, made from a cell's configuration.
//
//   auto access = AccessPoint::open(config, {control, &records}, log,
//                                   [&](auto json) { feed.set_forces(json); });
//   (*http)->serve_api((*access)->guard());
//
// Threads: as its parts. What it is given outlives it.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cell/config/hmi_config.h"
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
#include "hmi_web/api/request_guard.h"
#include "hmi_web/api/screen_service.h"
#include "hmi_web/change/removed_variables.h"
#include "hmi_web/storage/file_lock.h"
#include "hmi_web/trends/trend_store.h"
#include "runtime/ground/log/logger.h"
#include "runtime/ground/result/result.h"

namespace stepwright::hmi {

// Interfaces to the cell for the routes.
struct ActsOn {
  api::CellControl& cell;
  api::CellRecords* records = nullptr;              // null: the server keeps none
  api::CellFigures* figures = nullptr;              // null: it follows no runtime
  const std::string* drawing = nullptr;             // null: there is none
  api::CellProgram* program = nullptr;              // null: it serves no sources
  api::CellChange* change = nullptr;                // null: no program is changed from it
  api::CellMonitor* monitor = nullptr;              // null: it watches none
  api::CellNotifications* notifications = nullptr;  // null: it tells nobody
};

class AccessPoint {
 public:
  // Writes the set-up token to standard error, which is the journal of a service and never a log file, while
  // nobody has claimed the administrator. `port` is the page's. Fails with H0004 if another server keeps one
  // of the folders, with H0021 and H0022, and with what is wrong in the file of recipes (C0001 to C0006,
  // C0620 to C0622).
  [[nodiscard]] static result::Result<std::unique_ptr<AccessPoint>> open(
      const config::HmiConfig& config, std::uint16_t port, const ActsOn& what, log::Logger& log,
      api::ForceService::OnChange on_forces);

  const api::RequestGuard& guard() const { return *guard_; }
  // Now and then: what became of a program that was changed, and of what named its variables.
  void turn();

 private:
  AccessPoint() = default;
  [[nodiscard]] result::Result<void> open_recipes(const config::HmiConfig& config, api::CellControl& cell);
  [[nodiscard]] result::Result<void> open_versions(const config::HmiConfig& config, api::CellChange* cell,
                                                   log::Logger& log);

  [[nodiscard]] result::Result<void> open_screens(const config::HmiConfig& config, api::CellControl& cell,
                                                  log::Logger& log);

  // Users, trail, recipes, programs and screens have one server at a time.
  [[nodiscard]] result::Result<void> lock_folders(const config::HmiConfig& config);

  api::CellControl* cell_ = nullptr;
  std::vector<storage::FileLock> locks_;
  std::unique_ptr<access::AccessControl> control_;
  std::unique_ptr<access::AuditLog> audit_;
  std::unique_ptr<api::ForceService> forces_;
  std::unique_ptr<recipes::RecipeStore> store_;  // null, as what follows: the cell has no recipes
  std::unique_ptr<api::RecipeService> recipes_;
  std::unique_ptr<trends::TrendStore> trends_;      // null: no history is kept
  std::unique_ptr<change::VersionStore> versions_;  // null, as what follows: no program is changed
  std::unique_ptr<api::OnlineChangeService> changes_;
  std::unique_ptr<screens::ScreenStore> drawn_;
  std::unique_ptr<api::ScreenService> screens_;
  std::optional<change::RemovedVariables> removed_;
  std::unique_ptr<api::RouteTable> table_;
  std::unique_ptr<api::RequestGuard> guard_;
};

// Where the page is served: beyond this machine only once there is an administrator.
struct Listening {
  std::string host;
  bool held_back = false;  // the configuration names another host
};
[[nodiscard]] result::Result<Listening> listening_of(const config::HmiConfig& config);

// `stepwright hmi --verify-audit FILE`; the exit code: 0, or 1 with the first line that is wrong.
int verify_audit(const std::string& file);
// `stepwright hmi --openapi`.
int print_openapi();

}  // namespace stepwright::hmi
