#include "hmi_web/api/request_guard.h"

#include <algorithm>
#include <utility>

#include "hmi_web/access/secrets.h"
#include "hmi_web/api/internal/known_names.h"

namespace stepwright::api {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t from = std::min(text.find_first_not_of(' '), text.size());
  const std::size_t to = text.find_last_not_of(' ');
  return to == std::string_view::npos ? std::string_view() : text.substr(from, to + 1 - from);
}

// The first cookie of that name; browsers send the most specific one first, and "__Host-" allows one only.
std::string_view cookie_named(std::string_view header, std::string_view name) {
  while (!header.empty()) {
    const std::size_t end = std::min(header.find(';'), header.size());
    const std::string_view pair = trimmed(header.substr(0, end));
    header.remove_prefix(std::min(end + 1, header.size()));
    if (pair.starts_with(name) && pair.substr(name.size()).starts_with('='))
      return pair.substr(name.size() + 1);
  }
  return {};
}

bool is_json(std::string_view content_type) {
  return trimmed(content_type.substr(0, content_type.find(';'))) == "application/json";
}

// What is misspelt must not look as if it had been heeded.
Answer unknown_parameter(const std::string& name, const std::vector<Parameter>& known) {
  std::vector<std::string> names;
  for (const Parameter& each : known) names.push_back(each.name);
  const std::string shown = name.substr(0, kMostNameBytes);
  return refused(400, "H0060", "there is no parameter '" + shown + "'", names_hint(shown, names));
}

std::string result_of(const Answer& answer) {
  return answer.status < 400 ? "done" : "refused: " + answer.refusal;
}

access::AuditEntry entry_of(const Route& route, const Call& call, const Answer& answer,
                            const std::string& result) {
  std::string target = answer.target.empty() ? call.body.text("name") : answer.target;
  for (const auto& [name, value] : call.parameters) {
    if (target.empty()) target = value;
  }
  const bool logs_in = call.who.user.empty() && !answer.user.empty();
  return {.user = logs_in ? answer.user : call.who.user,
          .role = access::to_string(call.who.role),
          .address = call.who.address,
          .action = route.name,
          .target = std::move(target),
          .before = answer.before,
          .after = answer.after,
          .reason = call.body.text("reason"),
          .result = result};
}

}  // namespace

RequestGuard::RequestGuard(const RouteTable& table, access::AccessControl& control, access::AuditLog& audit,
                           const RequestGuardOptions& options)
    : table_(table),
      control_(control),
      audit_(audit),
      options_({std::min(options.anonymous, Role::Viewer), options.looks, options.cookie, options.refusals,
                options.clock}),
      refusals_(options.refusals, options.clock) {}

std::string cookie_at(std::uint16_t port) {
  return std::string(kSessionCookie) + "-" + std::to_string(port);
}

Caller RequestGuard::caller_of(const Request& request, const Route& route) const {
  Caller who;
  who.address = request.peer;
  if (request.peer_is_local) who.role = options_.anonymous;
  if (options_.looks && options_.looks(request.peer)) who.role = std::max(who.role, Role::Viewer);
  const std::string_view token = cookie_named(request.cookie, options_.cookie);
  if (token.empty()) return who;
  // Open pages ask for records by themselves every few seconds: nobody is there because of that.
  const bool looks = route.lane == Lane::Records;
  if (auto session = looks ? control_.sessions().find(token) : control_.sessions().use(token)) {
    who.user = session->user;
    who.role = session->role;
    who.token = std::string(token);
    who.csrf = session->csrf;
  }
  return who;
}

std::optional<Answer> RequestGuard::refusal_of(const Route& route, const Caller& who,
                                               const Request& request) const {
  const bool changes = route.method != "GET";
  if (changes && !request.own_origin) {
    return refused(403, "H0043", "this request does not come from this server's own page",
                   "programs name the server's address in the header Origin");
  }
  if (who.role < route.least) {
    if (who.user.empty()) return refused(401, "H0041", "nobody has logged in", "log in first");
    return refused(403, "H0042",
                   std::string("this takes the role ") + access::to_string(route.least) + ", yours is " +
                       access::to_string(who.role),
                   "ask an administrator");
  }
  const bool listens = route.lane == Lane::Server && !who.token.empty() && route.csrf;
  if (route.csrf && (changes || listens) &&
      (who.csrf.empty() || !access::same_secret(request.csrf, who.csrf))) {
    return refused(403, "H0044", "the CSRF token is missing or wrong",
                   "GET /api/session says it; send it as " + std::string(kCsrfHeader));
  }
  if (!route.body.name.empty() && !is_json(request.content_type))
    return refused(415, "H0045", "the body is to be application/json");
  return std::nullopt;
}

Admission RequestGuard::admit(const Request& request) const {
  Match match = table_.find(request.method, request.target);
  Admission admission;
  if (match.route == nullptr) {
    admission.allowed = match.allowed;
    admission.refusal = refused(
        match.allowed.empty() ? 404 : 405, "H0040",
        match.allowed.empty() ? "there is nothing here" : "there is no such method here", match.allowed);
    return admission;
  }
  admission.call.who = caller_of(request, *match.route);
  if (auto refusal = refusal_of(*match.route, admission.call.who, request)) {
    admission.refusal = *std::move(refusal);
    // Who was not let in although there is somebody, or by another page; never by waiting for the disk.
    if (admission.refusal.status == 403) {
      admission.call.parameters = std::move(match.parameters);
      if (auto entry = refusal_entry(*match.route, admission.call, admission.refusal))
        audit_.append_later(*std::move(entry));
    }
    return admission;
  }
  if (!match.readable) {
    admission.refusal = refused(400, "H0060", "a parameter cannot be read",
                                "a percent sign is followed by two hexadecimal digits, and not by 00");
    return admission;
  }
  if (!match.unknown.empty()) {
    admission.refusal = unknown_parameter(match.unknown, match.route->query);
    return admission;
  }
  admission.call.parameters = std::move(match.parameters);
  admission.route = match.route;
  return admission;
}

Answer RequestGuard::perform(Admission admission, std::string_view body) const {
  const Route& route = *admission.route;
  if (!route.body.name.empty()) {
    auto read = read_body(body, route.body);
    if (!read) return refused(400, read.error());
    admission.call.body = std::move(*read);
  } else if (!body.empty()) {
    return refused(400, "H0030", "this takes no body");
  }
  if (route.audit == Audit::None) return route.handler(admission.call);
  return route.audit == Audit::Later ? told_later(route, admission.call) : told(route, admission.call);
}

Answer RequestGuard::told(const Route& route, const Call& call) const {
  if (route.audit == Audit::Around && !audit_.append(entry_of(route, call, {}, "begun")))
    return refused(503, "H0046", "the audit trail cannot be written", "is the disk full? Nothing was done");
  Answer answer = route.handler(call);
  // What is locked is not told again and again: whoever guesses must not fill the disk.
  if (answer.status == 429) return answer;
  if (answer.status >= 400) {
    // What has begun has an end in the trail, too.
    const auto entry = route.audit == Audit::Around ? entry_of(route, call, answer, result_of(answer))
                                                    : refusal_entry(route, call, answer);
    if (entry) static_cast<void>(audit_.append(*entry));
  } else if (!audit_.append(entry_of(route, call, answer, result_of(answer)))) {
    answer =
        refused(503, "H0046", "it was done, but the audit trail could not be written", "is the disk full?");
  }
  return answer;
}

Answer RequestGuard::told_later(const Route& route, const Call& call) const {
  audit_.append_later(entry_of(route, call, {}, "begun"));
  Answer answer = route.handler(call);
  audit_.append_later(entry_of(route, call, answer, result_of(answer)));
  return answer;
}

std::optional<access::AuditEntry> RequestGuard::refusal_entry(const Route& route, const Call& call,
                                                              const Answer& answer) const {
  const auto told = refusals_.take(call.who.user);
  if (!told) return std::nullopt;
  std::string result = result_of(answer);
  if (told->left_out > 0)
    result += " (" + std::to_string(told->left_out) + " refusals before it are not listed)";
  return entry_of(route, call, answer, result);
}

bool RequestGuard::may_listen(const Caller& who) const {
  if (who.token.empty()) return true;  // anonymous: admitted for good
  return control_.sessions().find(who.token).has_value();
}

}  // namespace stepwright::api
