#include "hmi_web/access/access_control.h"

#include <algorithm>
#include <utility>

#include "hmi_web/storage/private_files.h"
#include "runtime/ground/files/durable_file.h"

namespace stepwright::access {
namespace {

// Many people may share an address, but not many of them forget their password at once.
LoginLimits for_addresses(LoginLimits limits) {
  limits.free_failures *= 4;
  return limits;
}

Refusal refusal(result::Diagnostics problems) {
  return {.problems = std::move(problems)};
}

tl::unexpected<Refusal> not_known(std::string message) {
  return tl::unexpected(Refusal{.cause = Refusal::Cause::NotKnown,
                                .problems = result::fail("H0026", {}, std::move(message)).value()});
}

tl::unexpected<Refusal> not_this_token(std::string message, std::string hint) {
  return tl::unexpected(
      Refusal{.cause = Refusal::Cause::NotThisToken,
              .problems = result::fail("H0028", {}, std::move(message), std::move(hint)).value()});
}

}  // namespace

AccessControl::AccessControl(std::unique_ptr<UserStore> users, const AccessOptions& options,
                             const Clock& clock)
    : options_(options),
      users_(std::move(users)),
      sessions_(options.sessions, clock),
      names_(options.logins, clock),
      addresses_(for_addresses(options.logins), clock) {
  if (!users_->has_administrator()) setup_token_ = random_setup_token();
}

result::Result<std::unique_ptr<AccessControl>> AccessControl::open(const std::filesystem::path& folder,
                                                                   const AccessOptions& options,
                                                                   const Clock& clock) {
  if (auto made = files::make_private_folder(folder, storage::kPrivateFile); !made)
    return result::forward(made);
  auto users = UserStore::open(folder / "users.json");
  if (!users) return result::forward(users);
  return std::unique_ptr<AccessControl>(new AccessControl(std::move(*users), options, clock));
}

std::optional<std::string> AccessControl::setup_token() const {
  const std::lock_guard lock(setup_mutex_);
  return setup_token_.empty() ? std::nullopt : std::optional(setup_token_);
}

tl::expected<OpenedSession, Refusal> AccessControl::claim(std::string_view token, const std::string& name,
                                                          const std::string& password,
                                                          const std::string& address) {
  const std::lock_guard lock(setup_mutex_);
  // The token is too long to be guessed: whoever has it does not wait for those who try.
  const bool right = !setup_token_.empty() && same_secret(token, setup_token_);
  if (!right) {
    if (auto wait = locked("", address)) return tl::unexpected(*std::move(wait));
    if (setup_token_.empty()) return not_this_token("there is an administrator already", "log in");
    addresses_.failed(address);
    return not_this_token("this is not the set-up token",
                          "it stands in the journal, or on the terminal where the server was started");
  }
  const auto hash = hash_of(name, password);
  if (!hash) return tl::unexpected(refusal(hash.error()));
  const std::lock_guard rights(rights_);
  if (auto added = users_->add(name, Role::Administrator, *hash); !added)
    return tl::unexpected(refusal(added.error()));
  setup_token_.clear();
  known_logins_.remember(name, address);
  return sessions_.open(name, Role::Administrator, address);
}

tl::expected<OpenedSession, Refusal> AccessControl::log_in(const std::string& name,
                                                           const std::string& password,
                                                           const std::string& address) {
  // Who is at home here answers for his own failures only, and not for those of others with his name or
  // address.
  const bool familiar = known_logins_.knows(name, address);
  const std::string key = familiar ? name + "\n" + address : name;
  if (auto wait = locked(key, familiar ? "" : address)) return tl::unexpected(*std::move(wait));
  const auto user = users_->find(name);
  // Nobody's password is hashed as well: how long it takes does not tell who is there.
  const bool right = matches(user ? user->password_hash : std::string(), password) && user;
  if (!right) {
    names_.failed(key);
    addresses_.failed(address);
    return not_known("name or password are wrong");
  }
  // The rights may have changed while the password was hashed; from here on they wait.
  const std::lock_guard rights(rights_);
  const auto present = users_->find(name);
  if (!present || present->password_hash != user->password_hash)
    return not_known("name or password are wrong");
  names_.succeeded(key);
  known_logins_.remember(name, address);
  return sessions_.open(name, present->role, address);
}

result::Result<void> AccessControl::add_user(const std::string& name, Role role,
                                             const std::string& password) {
  const auto hash = hash_of(name, password);
  if (!hash) return tl::unexpected(hash.error());
  return users_->add(name, role, *hash);
}

result::Result<void> AccessControl::set_role(const std::string& name, Role role) {
  const std::lock_guard rights(rights_);
  if (auto set = users_->set_role(name, role); !set) return set;
  sessions_.close_user(name);
  return {};
}

result::Result<void> AccessControl::remove_user(const std::string& name) {
  const std::lock_guard rights(rights_);
  if (auto removed = users_->remove(name); !removed) return removed;
  sessions_.close_user(name);
  return {};
}

result::Result<void> AccessControl::reset_password(const std::string& name, const std::string& password) {
  const auto hash = hash_of(name, password);
  if (!hash) return tl::unexpected(hash.error());
  const std::lock_guard rights(rights_);
  if (auto set = users_->set_password(name, *hash); !set) return set;
  sessions_.close_user(name);
  return {};
}

tl::expected<void, Refusal> AccessControl::change_password(const std::string& name,
                                                           const std::string& present,
                                                           const std::string& fresh, std::string_view token) {
  if (auto wait = locked(name, "")) return tl::unexpected(*std::move(wait));
  const auto user = users_->find(name);
  if (!user || !matches(user->password_hash, present)) {
    names_.failed(name);
    return not_known("the present password is wrong");
  }
  const auto hash = hash_of(name, fresh);
  if (!hash) return tl::unexpected(refusal(hash.error()));
  const std::lock_guard rights(rights_);
  if (auto set = users_->set_password(name, *hash); !set) return tl::unexpected(refusal(set.error()));
  sessions_.close_user(name, token);
  return {};
}

std::optional<Refusal> AccessControl::locked(const std::string& name, const std::string& address) const {
  const auto wait = std::max(name.empty() ? std::chrono::seconds(0) : names_.locked_for(name),
                             address.empty() ? std::chrono::seconds(0) : addresses_.locked_for(address));
  if (wait.count() == 0) return std::nullopt;
  return Refusal{.cause = Refusal::Cause::TooManyAttempts,
                 .problems = result::fail("H0027", {}, "too many failed attempts",
                                          "wait " + std::to_string(wait.count()) + " s and try again")
                                 .value(),
                 .retry_after = wait};
}

bool AccessControl::matches(const std::string& hash, const std::string& password) {
  if (password.size() > kMaxPasswordLength) return false;
  const std::lock_guard lock(hashing_);
  if (!hash.empty()) return password_matches(hash, password);
  if (decoy_hash_.empty()) decoy_hash_ = hash_password(random_token(), options_.cost).value_or("");
  return password_matches(decoy_hash_, password);
}

result::Result<std::string> AccessControl::hash_of(const std::string& name, const std::string& password) {
  if (auto fits = check_name(name); !fits) return result::forward(fits);
  if (auto fits = check_password(password, name); !fits) return result::forward(fits);
  const std::lock_guard lock(hashing_);
  return hash_password(password, options_.cost);
}

}  // namespace stepwright::access
