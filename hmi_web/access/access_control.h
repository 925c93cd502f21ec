#pragma once

// Logging in and out: users, their sessions, the lock against guessing, and the set-up token with which the
// first administrator is claimed. There is no default password.
//
//   auto control = AccessControl::open("cell-state/access", {}, std::chrono::steady_clock::now);
//   if (const auto token = (*control)->setup_token()) print(*token);   // once, where only the owner reads it
//   auto opened = (*control)->log_in("ada", password, "10.0.0.7");
//
// Threads: every function from any; logging in, claiming and setting passwords take a tenth of a second.
// One password is hashed at a time: memory is bounded.
//
// Diagnostics: H0026 name or password are wrong, H0027 locked for a while, H0028 there is nothing to claim or
// the token is wrong; H002x of users and files.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "hmi_web/access/login_guard.h"
#include "hmi_web/access/secrets.h"
#include "hmi_web/access/session_table.h"
#include "hmi_web/access/user_store.h"
#include "runtime/ground/result/result.h"

namespace stepwright::access {

struct AccessOptions {
  SessionLimits sessions;
  LoginLimits logins;
  PasswordCost cost;
};

// A refusal, perhaps one that time mends.
struct Refusal {
  enum class Cause : std::uint8_t {
    WrongWords,       // what was asked for cannot be: a name, a password, a file
    NotKnown,         // name and password do not belong to anybody
    NotThisToken,     // the administrator cannot be claimed with it
    TooManyAttempts,  // wait first
  };
  Cause cause = Cause::WrongWords;
  result::Diagnostics problems;
  std::chrono::seconds retry_after{0};
};

class AccessControl {
 public:
  // Makes the folder. Fails as UserStore::open.
  [[nodiscard]] static result::Result<std::unique_ptr<AccessControl>> open(
      const std::filesystem::path& folder, const AccessOptions& options, const Clock& clock);

  // While nobody has claimed the administrator; a new one after each start.
  std::optional<std::string> setup_token() const;
  [[nodiscard]] tl::expected<OpenedSession, Refusal> claim(std::string_view token, const std::string& name,
                                                           const std::string& password,
                                                           const std::string& address);
  [[nodiscard]] tl::expected<OpenedSession, Refusal> log_in(const std::string& name,
                                                            const std::string& password,
                                                            const std::string& address);

  // Users; what takes rights away ends the user's sessions.
  [[nodiscard]] result::Result<void> add_user(const std::string& name, Role role,
                                              const std::string& password);
  [[nodiscard]] result::Result<void> set_role(const std::string& name, Role role);
  [[nodiscard]] result::Result<void> remove_user(const std::string& name);
  // By an administrator.
  [[nodiscard]] result::Result<void> reset_password(const std::string& name, const std::string& password);
  // By the user, who knows the present one; the session of `token` goes on, the user's others end.
  [[nodiscard]] tl::expected<void, Refusal> change_password(const std::string& name,
                                                            const std::string& present,
                                                            const std::string& fresh, std::string_view token);

  SessionTable& sessions() { return sessions_; }
  const UserStore& users() const { return *users_; }

 private:
  AccessControl(std::unique_ptr<UserStore> users, const AccessOptions& options, const Clock& clock);

  std::optional<Refusal> locked(const std::string& name, const std::string& address) const;
  bool matches(const std::string& hash, const std::string& password);
  [[nodiscard]] result::Result<std::string> hash_of(const std::string& name, const std::string& password);

  const AccessOptions options_;
  std::unique_ptr<UserStore> users_;
  SessionTable sessions_;
  LoginGuard names_;
  LoginGuard addresses_;
  KnownLogins known_logins_;
  // Held while rights change and sessions end, and while a session is opened with the rights that were found.
  std::mutex rights_;
  std::mutex hashing_;
  std::string decoy_hash_;  // what the password of nobody is compared with; guarded by hashing_
  mutable std::mutex setup_mutex_;
  std::string setup_token_;  // guarded by setup_mutex_; empty: claimed
};

}  // namespace stepwright::access
