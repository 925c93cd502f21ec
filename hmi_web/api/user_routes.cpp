#include <nlohmann/json.hpp>

#include "hmi_web/access/codes.h"
#include "hmi_web/api/routes.h"

namespace stepwright::api {
namespace {

using nlohmann::json;

const std::vector<std::string> kRoles = {"viewer", "operator", "engineer", "administrator"};
const Field kName{.name = "name", .least = 1, .most = access::kMaxNameLength, .description = "of the user"};
const Field kRole{.name = "role", .most = 16, .choices = kRoles, .description = "what the user may do"};
const Field kPassword{
    .name = "password", .least = 1, .most = 128, .description = "which the user may change"};

Answer list_users(access::AccessControl& control) {
  json users = json::array();
  for (const auto& user : control.users().all())
    users.push_back({{"name", user.name}, {"role", access::to_string(user.role)}});
  json sessions = json::array();
  const auto now = std::chrono::steady_clock::now();
  for (const auto& session : control.sessions().all()) {
    const auto age = [&](auto since) {
      return std::chrono::duration_cast<std::chrono::seconds>(now - since).count();
    };
    sessions.push_back({{"id", session.id},
                        {"user", session.user},
                        {"role", access::to_string(session.role)},
                        {"address", session.address},
                        {"age_s", age(session.begun)},
                        {"idle_s", age(session.used)}});
  }
  Answer answer;
  answer.text = json{{"users", std::move(users)}, {"sessions", std::move(sessions)}}.dump();
  return answer;
}

// The list as it is afterwards, or why there was no change.
Answer changed(access::AccessControl& control, const result::Result<void>& done, const std::string& target,
               std::string before, std::string after) {
  Answer answer = done ? list_users(control) : refused(done.error());
  answer.target = target;
  answer.before = std::move(before);
  answer.after = std::move(after);
  return answer;
}

std::string role_text(const access::AccessControl& control, const std::string& name) {
  const auto user = control.users().find(name);
  return user ? access::to_string(user->role) : "";
}

Route row(const char* method, const char* path, const char* name, const char* summary) {
  return acting_row(method, path, name, summary, R"({"type": "object", "required": ["users", "sessions"],
    "properties": {"users": {"type": "array", "items": {"type": "object"}},
                   "sessions": {"type": "array", "items": {"type": "object"}}}})");
}

Route list_row(access::AccessControl* control) {
  Route route = row("GET", "/api/users", "user.list", "All users and who has logged in");
  route.audit = Audit::None;
  route.handler = [control](const Call&) { return list_users(*control); };
  return route;
}

Route add_row(access::AccessControl* control) {
  Route route = row("POST", "/api/users", "user.add", "Adds a user");
  route.lane = Lane::Password;
  route.body = {"NewUser", {kName, kRole, kPassword}};
  route.handler = [control](const Call& call) {
    const std::string& name = call.body.text("name");
    const std::string& role = call.body.text("role");
    return changed(*control, control->add_user(name, *access::role_of(role), call.body.text("password")),
                   name, "", role);
  };
  return route;
}

Route role_row(access::AccessControl* control) {
  Route route =
      row("PUT", "/api/users/{name}/role", "user.role", "Gives a user another role and ends the sessions");
  route.body = {"NewRole", {kRole}};
  route.handler = [control](const Call& call) {
    const std::string& name = call.parameter("name");
    const std::string before = role_text(*control, name);
    const std::string& role = call.body.text("role");
    return changed(*control, control->set_role(name, *access::role_of(role)), name, before, role);
  };
  return route;
}

Route password_row(access::AccessControl* control) {
  Route route = row("PUT", "/api/users/{name}/password", "user.password",
                    "Gives a user another password and ends the sessions");
  route.lane = Lane::Password;
  route.body = {"NewPassword", {kPassword}};
  route.handler = [control](const Call& call) {
    const std::string& name = call.parameter("name");
    return changed(*control, control->reset_password(name, call.body.text("password")), name, "", "");
  };
  return route;
}

Route remove_row(access::AccessControl* control) {
  Route route = row("DELETE", "/api/users/{name}", "user.remove", "Removes a user and ends the sessions");
  route.handler = [control](const Call& call) {
    const std::string& name = call.parameter("name");
    const std::string before = role_text(*control, name);
    return changed(*control, control->remove_user(name), name, before, "");
  };
  return route;
}

Route revoke_row(access::AccessControl* control) {
  Route route = row("DELETE", "/api/sessions/{id}", "session.revoke", "Ends somebody's session");
  route.handler = [control](const Call& call) {
    const std::string& id = call.parameter("id");
    if (!control->sessions().close_id(id))
      return refused(404, access::kNoSuchSession, "there is no such session");
    return changed(*control, {}, id, "", "");
  };
  return route;
}

}  // namespace

std::vector<Route> user_routes(const Services& services) {
  return {list_row(services.control),     add_row(services.control),    role_row(services.control),
          password_row(services.control), remove_row(services.control), revoke_row(services.control)};
}

}  // namespace stepwright::api
