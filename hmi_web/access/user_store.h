#pragma once

// Store of the users, who may log in: names, roles and argon2id hashes in one JSON file of mode 0600.
//
//   auto users = UserStore::open("cell-state/access/users.json");
//   (*users)->add("ada", Role::Operator, hash);
//   if (const auto user = (*users)->find("ada")) ...
//
// Threads: every function from any. Invariants: what a call has confirmed is on the disk; once there was an
// administrator there is always one.
//
// Diagnostics: H0021 the file cannot be written, H0022 it is damaged (with its place), H0023 a name or a
// password that cannot be one, H0024 no such user, H0029 a name twice, or one user too many, H0025 the last
// administrator would go.

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_web/access/role.h"
#include "runtime/ground/result/result.h"

namespace stepwright::access {

inline constexpr std::size_t kMaxUsers = 256;
inline constexpr std::size_t kMaxNameLength = 32;
inline constexpr std::size_t kMinPasswordLength = 10;
inline constexpr std::size_t kMaxPasswordLength = 128;

struct User {
  std::string name;
  Role role = Role::Viewer;
  std::string password_hash;
};

// Letters, digits and ". _ -", beginning with a letter.
[[nodiscard]] result::Result<void> check_name(std::string_view name);
// Long enough, and not the name.
[[nodiscard]] result::Result<void> check_password(std::string_view password, std::string_view name);

class UserStore {
 public:
  // A file that is not there has no users.
  [[nodiscard]] static result::Result<std::unique_ptr<UserStore>> open(const std::filesystem::path& file);

  std::vector<User> all() const;
  std::optional<User> find(std::string_view name) const;
  bool has_administrator() const;

  [[nodiscard]] result::Result<void> add(const std::string& name, Role role, std::string password_hash);
  [[nodiscard]] result::Result<void> set_role(std::string_view name, Role role);
  [[nodiscard]] result::Result<void> set_password(std::string_view name, std::string password_hash);
  [[nodiscard]] result::Result<void> remove(std::string_view name);

 private:
  UserStore(std::filesystem::path file, std::vector<User> users)
      : file_(std::move(file)), users_(std::move(users)) {}
  // Takes over `users` once they are on the disk.
  [[nodiscard]] result::Result<void> commit(std::vector<User> users);

  const std::filesystem::path file_;
  mutable std::mutex mutex_;
  std::vector<User> users_;  // guarded by mutex_; by name
};

}  // namespace stepwright::access
