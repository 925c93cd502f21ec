#pragma once

// Table of the sessions, one for each login. A session is named by a random token that only its browser
// knows; the table keeps the token's hash. Sessions live in memory: a restart of the server logs everybody
// out.
//
//   SessionTable sessions({}, std::chrono::steady_clock::now);
//   const OpenedSession opened = sessions.open("ada", Role::Operator);
//   if (const auto session = sessions.find(opened.token)) ...   // nullopt once it has expired
//
// Threads: every function from any. Invariant: at most `most` sessions; the one that has been idle longest
// gives way.

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_web/access/role.h"

namespace stepwright::access {

using Clock = std::function<std::chrono::steady_clock::time_point()>;

struct SessionLimits {
  std::chrono::seconds idle{30 * 60};           // without any request: over
  std::chrono::seconds absolute{12 * 60 * 60};  // after logging in: over in any case
  std::size_t most = 256;
};

struct OpenedSession {
  std::string token;  // for the cookie
  std::string csrf;   // for the page, which sends it with everything that changes something
};

struct Session {
  std::string id;  // names the session to people; no secret
  std::string user;
  Role role = Role::None;
  std::string csrf;
  std::string address;  // from which it was opened
  std::chrono::steady_clock::time_point begun;
  std::chrono::steady_clock::time_point used;
};

class SessionTable {
 public:
  SessionTable(const SessionLimits& limits, Clock clock) : limits_(limits), clock_(std::move(clock)) {}

  OpenedSession open(const std::string& user, Role role, const std::string& address);
  // The session of a token; using it keeps it from becoming idle.
  std::optional<Session> use(std::string_view token);
  // The same without using it: whoever only listens is idle.
  std::optional<Session> find(std::string_view token) const;
  std::vector<Session> all() const;

  void close(std::string_view token);
  // False if there is no such session.
  bool close_id(std::string_view id);
  // Every session of the user, but not the one of `except`.
  void close_user(std::string_view user, std::string_view except_token = {});

  const SessionLimits& limits() const { return limits_; }

 private:
  bool expired(const Session& session) const;
  void make_room();

  const SessionLimits limits_;
  const Clock clock_;
  mutable std::mutex mutex_;
  std::map<std::string, Session, std::less<>> sessions_;  // guarded by mutex_; by the token's SHA-256
};

}  // namespace stepwright::access
