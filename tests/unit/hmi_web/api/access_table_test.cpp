// Every route by every role with a session that is good, none, expired or forged. A route without a row here
// fails the test, and so does a row without a route.

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>

#include "tests/unit/hmi_web/api/request_guard_fixture.h"

namespace stepwright::api {
namespace {

// The least role that each route takes, said a second time: a slip in one of the two tables shows.
const std::map<std::string, Role>& expected_roles() {
  static const std::map<std::string, Role> kRoles = {
      {"GET /", Role::None},
      {"GET /{file}", Role::None},
      {"GET /assets/{file}", Role::None},
      {"GET /metrics", Role::None},
      {"GET /live", Role::Viewer},
      {"GET /api/session", Role::None},
      {"POST /api/session", Role::None},
      {"DELETE /api/session", Role::Viewer},
      {"POST /api/setup", Role::None},
      {"PUT /api/session/password", Role::Viewer},
      {"GET /api/users", Role::Administrator},
      {"POST /api/users", Role::Administrator},
      {"PUT /api/users/{name}/role", Role::Administrator},
      {"PUT /api/users/{name}/password", Role::Administrator},
      {"DELETE /api/users/{name}", Role::Administrator},
      {"DELETE /api/sessions/{id}", Role::Administrator},
      {"GET /api/audit", Role::Engineer},
      {"GET /api/audit/audit.jsonl", Role::Engineer},
      {"GET /api/audit/audit.csv", Role::Engineer},
      {"POST /api/runtime/stop", Role::Operator},
      {"POST /api/plan/abort", Role::Operator},
      {"POST /api/plan/hold", Role::Operator},
      {"POST /api/plan/resume", Role::Operator},
      {"POST /api/plan/goal", Role::Operator},
      {"POST /api/plan/change", Role::Operator},
      {"POST /api/plan/start", Role::Operator},
      {"POST /api/plan/what-if", Role::Operator},
      {"POST /api/plan/what-if/cancel", Role::Operator},
      {"GET /api/plan/goal-form", Role::Viewer},
      {"GET /api/plan/outlook", Role::Viewer},
      {"POST /api/fleet/order", Role::Operator},
      {"POST /api/fleet/block", Role::Operator},
      {"POST /api/fleet/unblock", Role::Operator},
      {"POST /api/fleet/return", Role::Operator},
      {"GET /api/forces", Role::Viewer},
      {"POST /api/tags/write", Role::Engineer},
      {"POST /api/tags/force", Role::Engineer},
      {"POST /api/tags/unforce", Role::Engineer},
      {"GET /api/faults", Role::Viewer},
      {"POST /api/faults/set", Role::Engineer},
      {"POST /api/faults/clear", Role::Engineer},
      {"GET /api/history/tags", Role::Viewer},
      {"GET /api/history/trend", Role::Viewer},
      {"GET /api/history/export.csv", Role::Viewer},
      {"GET /api/drawing", Role::Viewer},
      {"GET /api/screens", Role::Viewer},
      {"GET /api/screens/{name}", Role::Viewer},
      {"GET /api/screens/{name}/export.svg", Role::Viewer},
      {"GET /api/screens/{name}/versions", Role::Engineer},
      {"PUT /api/screens/{name}", Role::Engineer},
      {"DELETE /api/screens/{name}", Role::Engineer},
      {"PUT /api/screen-start", Role::Engineer},
      {"POST /api/screen-check", Role::Engineer},
      {"POST /api/screens/{name}/write", Role::Operator},
      {"GET /api/scan", Role::Viewer},
      {"GET /api/program", Role::Viewer},
      {"GET /api/program/live", Role::Viewer},
      {"GET /api/chart", Role::Viewer},
      {"GET /api/change", Role::Engineer},
      {"GET /api/change/diff", Role::Engineer},
      {"GET /api/change/sources", Role::Engineer},
      {"POST /api/change/check", Role::Engineer},
      {"POST /api/change/apply", Role::Engineer},
      {"GET /api/alarms", Role::Viewer},
      {"GET /api/alarms/journal", Role::Viewer},
      {"GET /api/alarms/journal.csv", Role::Viewer},
      {"POST /api/alarms/acknowledge", Role::Operator},
      {"POST /api/alarms/acknowledge-all", Role::Operator},
      {"GET /api/notifications", Role::Operator},
      {"POST /api/notifications/test", Role::Operator},
      {"GET /api/trends", Role::Viewer},
      {"PUT /api/trends/{name}", Role::Operator},
      {"DELETE /api/trends/{name}", Role::Operator},
      {"POST /api/alarms/reset", Role::Operator},
      {"POST /api/alarms/shelve", Role::Operator},
      {"POST /api/alarms/unshelve", Role::Operator},
      {"POST /api/alarms/suppress", Role::Operator},
      {"POST /api/alarms/unsuppress", Role::Operator},
      {"POST /api/alarms/remove", Role::Engineer},
      {"POST /api/history/calendar", Role::Engineer},
      {"POST /api/alarms/return", Role::Engineer},
      {"GET /api/recipe-tags", Role::Viewer},
      {"GET /api/recipes", Role::Viewer},
      {"GET /api/recipes/{name}", Role::Viewer},
      {"GET /api/recipes/{name}/compare", Role::Viewer},
      {"PUT /api/recipes/{name}", Role::Engineer},
      {"DELETE /api/recipes/{name}", Role::Engineer},
      {"POST /api/recipes/{name}/load", Role::Operator},
  };
  return kRoles;
}

enum class Credential { Good, None, Expired, Forged };

class AccessTableTest : public testing::Test {
 protected:
  // A path of the route, with something for each part in braces.
  static std::string target_of(const Route& row) {
    std::string target = row.path;
    for (std::size_t at = target.find('{'); at != std::string::npos; at = target.find('{'))
      target.replace(at, target.find('}') - at + 1, "x");
    return target;
  }

  // The status of the refusal; 0 = admitted.
  unsigned refusal(const Route& row, Role role, Credential credential) {
    access::OpenedSession session = fixture_.session(role);
    if (credential == Credential::None) session = {};
    if (credential == Credential::Expired) fixture_.now += fixture_.control->sessions().limits().idle;
    if (credential == Credential::Forged) session.token.back() = session.token.back() == 'A' ? 'B' : 'A';
    const std::string target = target_of(row);
    const std::string cookie = std::string(kSessionCookie) + "=" + session.token;
    Request request;
    request.method = row.method;
    request.target = target;
    request.cookie = session.token.empty() ? std::string_view() : cookie;
    request.csrf = session.csrf;
    request.content_type = "application/json";
    request.own_origin = true;
    request.peer = "127.0.0.1";
    request.peer_is_local = true;
    const Admission admission = fixture_.guard->admit(request);
    if (admission.route == nullptr) return admission.refusal.status;
    EXPECT_EQ(admission.route, &row) << target << " is taken for another route";
    return 0;
  }

  static constexpr std::array kRoles = {Role::Viewer, Role::Operator, Role::Engineer, Role::Administrator};
  RequestGuardFixture fixture_;
};

TEST_F(AccessTableTest, EveryRoute_HasARowAndEveryRowARoute) {
  std::map<std::string, Role> found;
  for (const Route& row : fixture_.table->rows()) found[row.method + " " + row.path] = row.least;
  EXPECT_EQ(found.size(), fixture_.table->rows().size());
  for (const auto& [route, role] : found) {
    const auto expected = expected_roles().find(route);
    ASSERT_NE(expected, expected_roles().end()) << route << " has no row in this test: who may use it?";
    EXPECT_EQ(role, expected->second) << route;
  }
  for (const auto& [route, role] : expected_roles())
    EXPECT_TRUE(found.contains(route)) << route << " is gone";
}

TEST_F(AccessTableTest, EveryRoute_WhenAnybodyAsks_ThenOnlyEnoughRightsAdmit) {
  for (const Route& row : fixture_.table->rows()) {
    const Role least = expected_roles().at(row.method + " " + row.path);
    for (const Role role : kRoles) {
      const std::string what = row.method + " " + row.path + " as " + access::to_string(role);
      EXPECT_EQ(refusal(row, role, Credential::Good), role >= least ? 0u : 403u) << what;
      const unsigned without = least == Role::None ? 0u : 401u;
      EXPECT_EQ(refusal(row, role, Credential::None), without) << what << " without a session";
      EXPECT_EQ(refusal(row, role, Credential::Expired), without) << what << " with an expired one";
      EXPECT_EQ(refusal(row, role, Credential::Forged), without) << what << " with a forged one";
    }
  }
}

TEST_F(AccessTableTest, EveryRouteThatChanges_WhenItIsNotFromThePage_ThenItIsRefused) {
  const access::OpenedSession session = fixture_.session(Role::Administrator);
  const access::OpenedSession other = fixture_.session(Role::Engineer);
  const std::string cookie = std::string(kSessionCookie) + "=" + session.token;
  for (const Route& row : fixture_.table->rows()) {
    const std::string target = target_of(row);
    Request request;
    request.method = row.method;
    request.target = target;
    request.cookie = cookie;
    request.csrf = session.csrf;
    request.content_type = "application/json";
    const bool changes = row.method != "GET";
    EXPECT_EQ(fixture_.guard->admit(request).refusal.status, changes ? 403u : 200u)
        << row.name << " without Origin";
    request.own_origin = true;
    for (const std::string& csrf : {std::string(), std::string("x"), other.csrf}) {
      request.csrf = csrf;
      const bool refused =
          row.name == "live.open" || (changes && row.name != "session.login" && row.name != "session.claim");
      EXPECT_EQ(fixture_.guard->admit(request).route == nullptr, refused)
          << row.name << " with token '" << csrf << "'";
    }
  }
}

TEST_F(AccessTableTest, EveryRouteThatChanges_IsAudited) {
  for (const Route& row : fixture_.table->rows()) {
    EXPECT_EQ(row.audit != Audit::None, row.method != "GET") << row.name;
    EXPECT_EQ(row.lane == Lane::Server, !row.handler) << row.name;
  }
}

}  // namespace
}  // namespace stepwright::api
