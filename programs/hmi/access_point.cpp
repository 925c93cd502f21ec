#include "programs/hmi/access_point.h"

#include <algorithm>
#include <cstdio>
#include <set>

#include "hmi_web/access/audit_files.h"
#include "hmi_web/api/openapi.h"
#include "hmi_web/api/routes.h"
#include "hmi_web/recipes/definition_file.h"
#include "hmi_web/storage/codes.h"
#include "hmi_web/storage/private_files.h"
#include "runtime/ground/files/durable_file.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/result/counted.h"
#include "runtime/ground/result/exit_code.h"

namespace stepwright::hmi {
namespace {

void tell_setup_token(const access::AccessControl& control, log::Logger& log) {
  const auto token = control.setup_token();
  if (!token) return;
  log.warning("setup", "nobody has claimed the administrator yet: the set-up token is on standard error");
  std::fprintf(stderr, "stepwright hmi: set-up token %s (claims the administrator on the page, once)\n",
               token->c_str());
  std::fflush(stderr);
}

std::function<bool(const std::string&)> looks_from(std::vector<network::IpRange> ranges) {
  if (ranges.empty()) return {};
  return [ranges = std::move(ranges)](const std::string& peer) {
    const auto address = network::parse_ip(peer);
    return address &&
           std::ranges::any_of(ranges, [&](const auto& range) { return range.contains(*address); });
  };
}

}  // namespace

result::Result<std::unique_ptr<AccessPoint>> AccessPoint::open(const config::HmiConfig& config,
                                                               std::uint16_t port, const ActsOn& what,
                                                               log::Logger& log,
                                                               api::ForceService::OnChange on_forces) {
  std::unique_ptr<AccessPoint> point(new AccessPoint);
  if (auto locked = point->lock_folders(config); !locked) return result::forward(locked);
  access::AccessOptions options;
  options.sessions.idle = config.idle;
  options.sessions.absolute = config.session;
  auto control = access::AccessControl::open(config.access_dir, options, std::chrono::steady_clock::now);
  if (!control) return result::forward(control);
  point->control_ = std::move(*control);
  auto audit = access::AuditLog::open(config.access_dir / "audit.jsonl");
  if (!audit) return result::forward(audit);
  point->audit_ = std::move(*audit);
  if (const std::string& found = point->audit_->found_at_start(); !found.empty())
    log.error("audit", "the audit trail " + point->audit_->file().string() + ": " + found);
  auto forces = api::ForceService::open(config.access_dir / "forces.json", what.cell, *point->audit_,
                                        std::chrono::system_clock::now, std::move(on_forces));
  if (!forces) return result::forward(forces);
  point->forces_ = std::move(*forces);
  if (auto opened = point->open_recipes(config, what.cell); !opened) return result::forward(opened);
  if (what.records != nullptr) {
    auto trends = trends::TrendStore::open(config.access_dir / "trends.json");
    if (!trends) return result::forward(trends);
    point->trends_ = std::move(*trends);
    if (!point->trends_->found_at_start().empty()) log.error("trends", point->trends_->found_at_start());
  }
  if (auto opened = point->open_versions(config, what.change, log); !opened) return result::forward(opened);
  if (auto opened = point->open_screens(config, what.cell, log); !opened) return result::forward(opened);
  point->cell_ = &what.cell;
  point->removed_.emplace(point->recipes_ ? &point->recipes_->tags() : nullptr, point->drawn_.get(), log);
  point->table_ = std::make_unique<api::RouteTable>(api::all_routes(
      {point->control_.get(), point->audit_.get(), point->forces_.get(), &what.cell, what.records,
       point->recipes_.get(), what.figures, what.drawing, what.program, point->changes_.get(), what.monitor,
       point->trends_.get(), what.notifications, config.wall.panels, point->screens_.get()}));
  point->guard_ = std::make_unique<api::RequestGuard>(
      *point->table_, *point->control_, *point->audit_,
      api::RequestGuardOptions{
          .anonymous = config.anonymous_viewer ? access::Role::Viewer : access::Role::None,
          .looks = looks_from(config.wall.addresses),
          .cookie = api::cookie_at(port)});
  tell_setup_token(*point->control_, log);
  return point;
}

result::Result<void> AccessPoint::lock_folders(const config::HmiConfig& config) {
  std::set<std::filesystem::path> folders{config.access_dir, config.programs_dir, config.screens_dir};
  if (!config.recipes.empty()) folders.insert(config.recipes_dir);
  for (const std::filesystem::path& folder : folders) {
    if (auto made = files::make_private_folder(folder, storage::kPrivateFile); !made)
      return result::forward(made);
    auto lock = storage::FileLock::take(folder / "server");
    if (!lock && storage::is_in_use(lock.error()))
      return result::fail("H0004", {folder.string(), 0, 0}, "another page server keeps this folder",
                          "end the other `stepwright hmi` of this cell; a cell has one");
    if (!lock) return result::forward(lock);
    locks_.push_back(std::move(*lock));
  }
  return {};
}

result::Result<void> AccessPoint::open_recipes(const config::HmiConfig& config, api::CellControl& cell) {
  if (config.recipes.empty()) return {};
  auto tags = recipes::load_definitions(config.recipes);
  if (!tags) return result::forward(tags);
  auto store = recipes::RecipeStore::open(config.recipes_dir);
  if (!store) return result::forward(store);
  store_ = std::move(*store);
  recipes_ = std::make_unique<api::RecipeService>(std::move(*tags), *store_, cell, *forces_,
                                                  std::chrono::system_clock::now);
  return {};
}

result::Result<void> AccessPoint::open_versions(const config::HmiConfig& config, api::CellChange* cell,
                                                log::Logger& log) {
  if (cell == nullptr) return {};
  auto versions = change::VersionStore::open(config.programs_dir);
  if (!versions) return result::forward(versions);
  versions_ = std::move(*versions);
  for (const result::Diagnostic& each : versions_->damaged())
    log.warning("programs", each.code + ": " + each.message, {{"file", each.where.file}});
  changes_ =
      std::make_unique<api::OnlineChangeService>(*cell, *versions_, *audit_, std::chrono::system_clock::now);
  return {};
}

result::Result<void> AccessPoint::open_screens(const config::HmiConfig& config, api::CellControl& cell,
                                               log::Logger& log) {
  auto store = screens::ScreenStore::open(config.screens_dir);
  if (!store) return result::forward(store);
  drawn_ = std::move(*store);
  // A screen that cannot be believed is not shown; the others are.
  for (const result::Diagnostic& each : drawn_->damaged())
    log.warning("screens", each.code + ": " + each.message,
                {{"file", each.where.file}, {"line", std::to_string(each.where.line)}});
  screens_ = std::make_unique<api::ScreenService>(*drawn_, cell, std::chrono::system_clock::now);
  return {};
}

void AccessPoint::turn() {
  if (changes_) changes_->turn();
  removed_->turn(cell_->program());
}

result::Result<Listening> listening_of(const config::HmiConfig& config) {
  if (config::is_loopback(config.host)) return Listening{config.host, false};
  auto users = access::UserStore::open(config.access_dir / "users.json");
  if (!users) return result::forward(users);
  if ((*users)->has_administrator()) return Listening{config.host, false};
  return Listening{"127.0.0.1", true};
}

int verify_audit(const std::string& file) {
  const auto trail = access::check_trail(file);
  if (!trail) return process::fail(trail.error(), result::ExitCode::BadInput);
  const access::ChainCheck& check = trail->chain;
  const std::uint64_t right = check.entries - (trail->first > 0 ? trail->first - 1 : 0);
  if (check.broken_line > 0) {
    const auto line = static_cast<std::uint32_t>(trail->line);
    const auto broken =
        result::fail("H0050", {trail->file.string(), line, 1}, "this line is wrong: " + check.why,
                     result::counted(right, "entry before it is", "entries before it are") + " right");
    return process::fail(broken.value(), result::ExitCode::BadInput);
  }
  const std::string begin = trail->first > 1 ? " from number " + std::to_string(trail->first) + " on" : "";
  std::printf("%s%s, head %s\n", result::counted(right, "entry", "entries").c_str(), begin.c_str(),
              check.head.c_str());
  return to_int(result::ExitCode::Done);
}

int print_openapi() {
  const api::RouteTable table(api::all_routes({}));
  std::fputs(api::openapi(table, STEPWRIGHT_VERSION).c_str(), stdout);
  return to_int(result::ExitCode::Done);
}

}  // namespace stepwright::hmi
