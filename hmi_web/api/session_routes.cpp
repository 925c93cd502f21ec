#include <nlohmann/json.hpp>

#include "hmi_web/api/routes.h"

namespace stepwright::api {
namespace {

using nlohmann::json;

const Field kName{.name = "name", .least = 1, .most = access::kMaxNameLength, .description = "of the user"};
// Rules for new passwords are checked where they are hashed.
const Field kPassword{
    .name = "password", .least = 1, .most = 128, .description = "in the clear: over TLS or loopback"};

constexpr const char* kSessionAnswer =
    R"({"type": "object", "required": ["user", "role", "csrf", "setup_needed"],
  "properties": {"user": {"type": "string", "description": "empty: nobody has logged in"},
                 "role": {"type": "string", "enum": ["none", "viewer", "operator", "engineer", "administrator"]},
                 "csrf": {"type": "string"}, "setup_needed": {"type": "boolean"},
                 "wall": {"type": "array", "items": {"type": "string"}, "description": "panels of /#wall; empty: by what the cell has"}}})";

Answer session_answer(const access::AccessControl& control, const std::string& user, Role role,
                      const std::string& csrf) {
  Answer answer;
  answer.text = json{{"user", user},
                     {"role", access::to_string(role)},
                     {"csrf", csrf},
                     {"setup_needed", control.setup_token().has_value()}}
                    .dump();
  return answer;
}

Answer answer_of(const access::Refusal& refusal) {
  switch (refusal.cause) {
    case access::Refusal::Cause::WrongWords:
      break;
    case access::Refusal::Cause::NotKnown:
      return refused(401, refusal.problems);
    case access::Refusal::Cause::NotThisToken:
      return refused(403, refusal.problems);
    case access::Refusal::Cause::TooManyAttempts:
      return refused(429, refusal.problems);
  }
  return refused(refusal.problems);
}

Answer refusal(const access::Refusal& refused_because) {
  Answer answer = answer_of(refused_because);
  answer.retry_after = refused_because.retry_after;
  return answer;
}

// What logging in and claiming answer.
Answer opened(access::AccessControl& control,
              const tl::expected<access::OpenedSession, access::Refusal>& session, const std::string& name) {
  if (!session) {
    Answer answer = refusal(session.error());
    answer.target = name;
    return answer;
  }
  const auto known = control.sessions().find(session->token);
  Answer answer = session_answer(control, name, known ? known->role : Role::None, session->csrf);
  answer.set_cookie = session->token;
  answer.user = name;
  answer.target = name;
  return answer;
}

Route row(const char* method, const char* path, const char* name, Role least, const char* summary) {
  Route route;
  route.method = method;
  route.path = path;
  route.name = name;
  route.least = least;
  route.summary = summary;
  route.answer = kSessionAnswer;
  return route;
}

Route read_row(access::AccessControl* control, const std::vector<std::string>& wall) {
  Route route = row("GET", "/api/session", "session.read", Role::None, "Who has logged in here");
  route.csrf = false;
  route.handler = [control, wall](const Call& call) {
    Answer answer = session_answer(*control, call.who.user, call.who.role, call.who.csrf);
    json document = json::parse(answer.text);
    document["wall"] = wall;
    answer.text = document.dump();
    return answer;
  };
  return route;
}

Route log_in_row(access::AccessControl* control) {
  Route route = row("POST", "/api/session", "session.login", Role::None, "Logs in");
  route.csrf = false;
  route.audit = Audit::After;
  route.lane = Lane::Password;
  route.body = {"LogIn", {kName, kPassword}};
  route.handler = [control](const Call& call) {
    const std::string name = call.body.text("name");
    const auto session = control->log_in(name, call.body.text("password"), call.who.address);
    // Whoever mistypes a password stays who he was.
    if (session && !call.who.token.empty()) control->sessions().close(call.who.token);
    return opened(*control, session, name);
  };
  return route;
}

Route log_out_row(access::AccessControl* control) {
  Route route = row("DELETE", "/api/session", "session.logout", Role::Viewer, "Logs out");
  route.audit = Audit::After;
  route.handler = [control](const Call& call) {
    control->sessions().close(call.who.token);
    Answer answer = session_answer(*control, "", Role::None, "");
    answer.set_cookie = "-";
    return answer;
  };
  return route;
}

Route claim_row(access::AccessControl* control) {
  Route route = row("POST", "/api/setup", "session.claim", Role::None,
                    "Claims the first administrator with the set-up token of the journal");
  route.csrf = false;
  route.audit = Audit::After;
  route.lane = Lane::Password;
  route.body = {"Claim",
                {{.name = "token", .least = 1, .most = 64, .description = "from the journal of the server"},
                 kName,
                 kPassword}};
  route.handler = [control](const Call& call) {
    const std::string name = call.body.text("name");
    return opened(*control,
                  control->claim(call.body.text("token"), name, call.body.text("password"), call.who.address),
                  name);
  };
  return route;
}

Route password_row(access::AccessControl* control) {
  Route route = row("PUT", "/api/session/password", "session.password", Role::Viewer,
                    "Changes the own password; the user's other sessions end");
  route.audit = Audit::After;
  route.lane = Lane::Password;
  route.body = {
      "ChangePassword",
      {{.name = "present", .least = 1, .most = 128, .description = "the password so far"}, kPassword}};
  route.handler = [control](const Call& call) {
    auto changed = control->change_password(call.who.user, call.body.text("present"),
                                            call.body.text("password"), call.who.token);
    if (!changed) return refusal(changed.error());
    return session_answer(*control, call.who.user, call.who.role, call.who.csrf);
  };
  return route;
}

}  // namespace

std::vector<Route> session_routes(const Services& services) {
  return {read_row(services.control, services.wall), log_in_row(services.control),
          log_out_row(services.control), claim_row(services.control), password_row(services.control)};
}

}  // namespace stepwright::api
