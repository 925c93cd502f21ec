#include "hmi_web/access/user_store.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "hmi_web/access/codes.h"
#include "hmi_web/access/secrets.h"
#include "hmi_web/storage/private_files.h"
#include "runtime/ground/files/durable_file.h"

namespace stepwright::access {
namespace {

using nlohmann::json;

constexpr std::size_t kMostUserBytes = std::size_t{16} << 20;

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool has_administrator_among(const std::vector<User>& users) {
  return std::any_of(users.begin(), users.end(),
                     [](const User& user) { return user.role == Role::Administrator; });
}

template <typename Users>
auto find_in(Users& users, std::string_view name) {
  return std::find_if(users.begin(), users.end(), [&](const User& user) { return user.name == name; });
}

tl::unexpected<result::Diagnostics> unknown(std::string_view name) {
  return result::fail(kNoSuchUser, {}, "there is no user '" + std::string(name) + "'");
}

tl::unexpected<result::Diagnostics> damaged(const std::filesystem::path& file, const std::string& what) {
  return result::fail("H0022", {file.string(), 0, 0}, "the file of users is damaged: " + what,
                      "restore it from a copy, or remove it to begin with a set-up token again");
}

std::optional<User> read_user(const json& entry) {
  if (!entry.is_object() || entry.size() != 3) return std::nullopt;
  const auto text = [&](const char* key) {
    const auto found = entry.find(key);
    return found != entry.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  const auto role = role_of(text("role"));
  User user{text("name"), role.value_or(Role::None), text("password")};
  if (!role || !check_name(user.name) || !is_password_hash(user.password_hash)) return std::nullopt;
  return user;
}

}  // namespace

result::Result<void> check_name(std::string_view name) {
  const bool fits = !name.empty() && name.size() <= kMaxNameLength && is_letter(name.front()) &&
                    std::all_of(name.begin(), name.end(), [](char c) {
                      return is_letter(c) || (c >= '0' && c <= '9') || c == '.' || c == '_' || c == '-';
                    });
  if (fits) return {};
  return result::fail("H0023", {}, "this cannot be the name of a user",
                      "a letter, then up to 31 letters, digits or . _ -");
}

result::Result<void> check_password(std::string_view password, std::string_view name) {
  if (password.size() < kMinPasswordLength) {
    return result::fail("H0023", {}, "the password is too short",
                        "at least " + std::to_string(kMinPasswordLength) + " characters");
  }
  if (password.size() > kMaxPasswordLength) {
    return result::fail("H0023", {}, "the password is too long",
                        "at most " + std::to_string(kMaxPasswordLength) + " bytes");
  }
  if (password == name) return result::fail("H0023", {}, "the password is the name", "choose another one");
  return {};
}

result::Result<std::unique_ptr<UserStore>> UserStore::open(const std::filesystem::path& file) {
  std::vector<User> users;
  auto text = files::read_text(file, kMostUserBytes, storage::kPrivateFile);
  if (!text) return result::forward(text);
  if (*text) {
    const json document = json::parse(**text, nullptr, /*allow_exceptions=*/false);
    if (!document.is_object() || !document.contains("users") || !document["users"].is_array())
      return damaged(file, "it is no list of users");
    for (const json& entry : document["users"]) {
      auto user = read_user(entry);
      const std::string number = std::to_string(users.size() + 1);
      if (!user) return damaged(file, "user " + number + " cannot be read");
      if (find_in(users, user->name) != users.end())
        return damaged(file, "user " + number + " is there twice");
      users.push_back(std::move(*user));
    }
  }
  return std::unique_ptr<UserStore>(new UserStore(file, std::move(users)));
}

std::vector<User> UserStore::all() const {
  const std::lock_guard lock(mutex_);
  return users_;
}

std::optional<User> UserStore::find(std::string_view name) const {
  const std::lock_guard lock(mutex_);
  const auto found = find_in(users_, name);
  return found == users_.end() ? std::nullopt : std::optional(*found);
}

bool UserStore::has_administrator() const {
  const std::lock_guard lock(mutex_);
  return has_administrator_among(users_);
}

result::Result<void> UserStore::add(const std::string& name, Role role, std::string password_hash) {
  if (auto fits = check_name(name); !fits) return fits;
  const std::lock_guard lock(mutex_);
  if (find_in(users_, name) != users_.end())
    return result::fail(kNoRoomForUser, {}, "there is a user '" + name + "' already",
                        "choose another name, or change the role of the one there is");
  if (users_.size() >= kMaxUsers)
    return result::fail(kNoRoomForUser, {}, "there are too many users", "remove one that nobody uses");
  auto users = users_;
  users.push_back({name, role, std::move(password_hash)});
  std::sort(users.begin(), users.end(), [](const User& a, const User& b) { return a.name < b.name; });
  return commit(std::move(users));
}

result::Result<void> UserStore::set_role(std::string_view name, Role role) {
  const std::lock_guard lock(mutex_);
  auto users = users_;
  const auto found = find_in(users, name);
  if (found == users.end()) return unknown(name);
  found->role = role;
  return commit(std::move(users));
}

result::Result<void> UserStore::set_password(std::string_view name, std::string password_hash) {
  const std::lock_guard lock(mutex_);
  auto users = users_;
  const auto found = find_in(users, name);
  if (found == users.end()) return unknown(name);
  found->password_hash = std::move(password_hash);
  return commit(std::move(users));
}

result::Result<void> UserStore::remove(std::string_view name) {
  const std::lock_guard lock(mutex_);
  auto users = users_;
  const auto found = find_in(users, name);
  if (found == users.end()) return unknown(name);
  users.erase(found);
  return commit(std::move(users));
}

result::Result<void> UserStore::commit(std::vector<User> users) {
  if (has_administrator_among(users_) && !has_administrator_among(users)) {
    return result::fail(kLastAdministrator, {}, "this is the only administrator",
                        "make another user an administrator first");
  }
  json list = json::array();
  for (const User& user : users) {
    list.push_back({{"name", user.name}, {"role", to_string(user.role)}, {"password", user.password_hash}});
  }
  if (auto written =
          files::replace_file(file_, json{{"users", std::move(list)}}.dump(1) + "\n", storage::kPrivateFile);
      !written)
    return written;
  users_ = std::move(users);
  return {};
}

}  // namespace stepwright::access
