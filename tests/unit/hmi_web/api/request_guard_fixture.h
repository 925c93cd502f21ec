#pragma once

// A guard with everything behind it, in a folder of its own, and a user of each role.

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hmi_web/access/audit_log.h"
#include "hmi_web/api/request_guard.h"
#include "hmi_web/api/routes.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/hmi_web/api/fake_cell.h"
#include "tests/unit/hmi_web/api/fake_change.h"
#include "tests/unit/hmi_web/api/fake_notifications.h"
#include "tests/unit/hmi_web/api/fake_records.h"

namespace stepwright::api {

inline constexpr const char* kPassword = "correct horse";

// A level from 0 to 100 %, and whether to stir.
inline std::vector<recipes::RecipeTag> recipe_tags() {
  return {{"mixer.level", bytecode::ElementaryType::Real, 0, 100, "%", "how full", {}},
          {"mixer.stir", bytecode::ElementaryType::Bool, 0, 0, "", "", {}}};
}

class RequestGuardFixture {
 public:
  explicit RequestGuardFixture(Role anonymous = Role::None,
                               std::function<bool(const std::string&)> looks = {}) {
    access::AccessOptions options;
    options.cost = {1, 8'192};
    control = *access::AccessControl::open(folder / "access", options, [this] { return now; });
    audit = *access::AuditLog::open(folder / "access/audit.jsonl");
    forces = *ForceService::open(folder / "access/forces.json", cell, *audit, std::chrono::system_clock::now,
                                 [](const std::string&) {});
    store = *recipes::RecipeStore::open(folder / "recipes");
    service =
        std::make_unique<RecipeService>(recipe_tags(), *store, cell, *forces, std::chrono::system_clock::now);
    trends = *trends::TrendStore::open(folder / "access/trends.json");
    versions = *change::VersionStore::open(folder / "programs");
    changes =
        std::make_unique<OnlineChangeService>(programs, *versions, *audit, std::chrono::system_clock::now);
    drawn = *screens::ScreenStore::open(folder / "screens");
    screen_service = std::make_unique<ScreenService>(*drawn, cell, std::chrono::system_clock::now);
    table = std::make_unique<RouteTable>(all_routes({control.get(),
                                                     audit.get(),
                                                     forces.get(),
                                                     &cell,
                                                     &records,
                                                     service.get(),
                                                     nullptr,
                                                     nullptr,
                                                     nullptr,
                                                     changes.get(),
                                                     nullptr,
                                                     trends.get(),
                                                     &notifications,
                                                     {},
                                                     screen_service.get()}));
    guard = std::make_unique<RequestGuard>(*table, *control, *audit,
                                           RequestGuardOptions{anonymous, std::move(looks)});
  }

  // A session of a user of that role, who is made the first time.
  access::OpenedSession session(Role role) {
    const std::string name = access::to_string(role);
    if (!control->users().find(name)) {
      EXPECT_TRUE(control->add_user(name, role, kPassword));
    }
    return control->sessions().open(name, role, "127.0.0.1");
  }

  // A request as a page of ours would send it.
  Answer ask(const std::string& method, const std::string& target, const std::string& body = {},
             const access::OpenedSession& as = {}) {
    const std::string cookie = std::string(kSessionCookie) + "=" + as.token;
    Request request;
    request.method = method;
    request.target = target;
    request.cookie = as.token.empty() ? std::string_view() : cookie;
    request.csrf = as.csrf;
    request.content_type = "application/json";
    request.own_origin = true;
    request.peer = "127.0.0.1";
    request.peer_is_local = true;
    return ask(request, body);
  }
  Answer ask(const Request& request, const std::string& body) const {
    Admission admission = guard->admit(request);
    if (admission.route == nullptr) return admission.refusal;
    if (admission.route->lane == Lane::Server) return {};
    return guard->perform(std::move(admission), body);
  }

  support::TemporaryFolder folder;
  std::chrono::steady_clock::time_point now{};
  FakeCell cell;
  FakeRecords records;
  std::unique_ptr<access::AccessControl> control;
  std::unique_ptr<access::AuditLog> audit;
  std::unique_ptr<ForceService> forces;
  std::unique_ptr<recipes::RecipeStore> store;
  std::unique_ptr<RecipeService> service;
  FakeChange programs;
  std::unique_ptr<trends::TrendStore> trends;
  FakeNotifications notifications;
  std::unique_ptr<change::VersionStore> versions;
  std::unique_ptr<OnlineChangeService> changes;
  std::unique_ptr<screens::ScreenStore> drawn;
  std::unique_ptr<ScreenService> screen_service;
  std::unique_ptr<RouteTable> table;
  std::unique_ptr<RequestGuard> guard;
};

}  // namespace stepwright::api
