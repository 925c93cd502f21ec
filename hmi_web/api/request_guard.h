#pragma once

// Admits or refuses every request by the route table: the route exists, the caller may use it, the request is
// of our own page, the body fits. Then it calls the handler and writes the audit trail. A request that brings
// the plant to rest is carried out even if the disk of the trail fails. Refusals are written up to a limit
// for each user.
//
//   RequestGuard guard(table, control, audit, {.anonymous = Role::Viewer});
//   const Admission admission = guard.admit(request);
//   if (!admission.route) return send(admission.refusal);
//   send(guard.perform(admission, body));                       // in the thread of the route's lane
//
// Threads: every function from any; `perform` blocks as the route's lane says. What it refers to outlives it.
//
// Diagnostics: H0040 no such route, H0041 log in, H0042 the role does not suffice, H0043 not from this page,
// H0044 the CSRF token is missing or wrong, H0045 not application/json, H0046 the audit trail cannot be
// written: nothing was done.

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "hmi_web/access/access_control.h"
#include "hmi_web/access/audit_log.h"
#include "hmi_web/access/refusal_budget.h"
#include "hmi_web/api/route.h"
#include "hmi_web/api/route_table.h"

namespace stepwright::api {

// Over TLS and, in the browsers that take secure cookies from loopback addresses, without it.
inline constexpr std::string_view kSessionCookie = "__Host-stepwright";
inline constexpr std::string_view kCsrfHeader = "X-CSRF-Token";
// A WebSocket has no headers of its own: its page offers the token as a subprotocol.
inline constexpr std::string_view kCsrfProtocol = "csrf.";

struct RequestGuardOptions {
  Role anonymous = Role::None;  // of whoever has not logged in, at this machine; never more than Viewer
  // Whether who calls from that address looks without logging in; empty: nobody does.
  std::function<bool(const std::string& peer)> looks = {};
  // Browsers send cookies to every port of a host: servers beside each other have names of their own.
  std::string cookie = std::string(kSessionCookie);
  access::RefusalLimits refusals = {};  // that the audit trail tells
  access::Clock clock = std::chrono::steady_clock::now;
};

// The name of the cookie of a server at that port.
std::string cookie_at(std::uint16_t port);

// A request as the server has read it; all but `peer` is untrusted.
struct Request {
  std::string_view method;
  std::string_view target;
  std::string_view cookie;
  std::string_view csrf;
  std::string_view content_type;
  bool own_origin = false;  // there is an Origin, and it is our page's
  std::string peer;         // address
  bool peer_is_local = false;
};

struct Admission {
  const Route* route = nullptr;  // null: see `refusal`
  Call call;
  Answer refusal;
  std::string allowed = {};  // of a 405
};

class RequestGuard {
 public:
  RequestGuard(const RouteTable& table, access::AccessControl& control, access::AuditLog& audit,
               const RequestGuardOptions& options);

  Admission admit(const Request& request) const;
  // Reads the body, writes the audit trail, calls the handler.
  Answer perform(Admission admission, std::string_view body) const;

  // Whether whoever was admitted with this token (empty: anonymously) may still listen.
  bool may_listen(const Caller& who) const;
  const RouteTable& table() const { return table_; }
  const std::string& cookie() const { return options_.cookie; }

 private:
  Caller caller_of(const Request& request, const Route& route) const;
  std::optional<Answer> refusal_of(const Route& route, const Caller& who, const Request& request) const;
  // The handler's answer, with what the audit trail is to have of it.
  Answer told(const Route& route, const Call& call) const;
  Answer told_later(const Route& route, const Call& call) const;
  // Nothing: refusals of this user are not told any more.
  std::optional<access::AuditEntry> refusal_entry(const Route& route, const Call& call,
                                                  const Answer& answer) const;

  const RouteTable& table_;
  access::AccessControl& control_;
  access::AuditLog& audit_;
  const RequestGuardOptions options_;
  mutable access::RefusalBudget refusals_;
};

}  // namespace stepwright::api
