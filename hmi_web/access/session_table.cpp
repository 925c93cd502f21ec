#include "hmi_web/access/session_table.h"

#include <algorithm>

#include "hmi_web/access/secrets.h"

namespace stepwright::access {
namespace {

constexpr std::size_t kIdLength = 12;

}  // namespace

OpenedSession SessionTable::open(const std::string& user, Role role, const std::string& address) {
  OpenedSession opened{random_token(), random_token()};
  const std::string key = sha256_hex(opened.token);
  const auto now = clock_();
  const std::lock_guard lock(mutex_);
  make_room();
  sessions_[key] = {key.substr(0, kIdLength), user, role, opened.csrf, address, now, now};
  return opened;
}

std::optional<Session> SessionTable::use(std::string_view token) {
  const std::string key = sha256_hex(token);
  const std::lock_guard lock(mutex_);
  const auto found = sessions_.find(key);
  if (found == sessions_.end()) return std::nullopt;
  if (expired(found->second)) {
    sessions_.erase(found);
    return std::nullopt;
  }
  found->second.used = clock_();
  return found->second;
}

std::optional<Session> SessionTable::find(std::string_view token) const {
  const std::string key = sha256_hex(token);
  const std::lock_guard lock(mutex_);
  const auto found = sessions_.find(key);
  if (found == sessions_.end() || expired(found->second)) return std::nullopt;
  return found->second;
}

std::vector<Session> SessionTable::all() const {
  const std::lock_guard lock(mutex_);
  std::vector<Session> list;
  for (const auto& [key, session] : sessions_) {
    if (!expired(session)) list.push_back(session);
  }
  return list;
}

void SessionTable::close(std::string_view token) {
  const std::string key = sha256_hex(token);
  const std::lock_guard lock(mutex_);
  sessions_.erase(key);
}

bool SessionTable::close_id(std::string_view id) {
  const std::lock_guard lock(mutex_);
  return std::erase_if(sessions_, [&](const auto& entry) { return entry.second.id == id; }) > 0;
}

void SessionTable::close_user(std::string_view user, std::string_view except_token) {
  const std::string kept = except_token.empty() ? std::string() : sha256_hex(except_token);
  const std::lock_guard lock(mutex_);
  std::erase_if(sessions_,
                [&](const auto& entry) { return entry.second.user == user && entry.first != kept; });
}

bool SessionTable::expired(const Session& session) const {
  const auto now = clock_();
  return now - session.used >= limits_.idle || now - session.begun >= limits_.absolute;
}

void SessionTable::make_room() {
  std::erase_if(sessions_, [this](const auto& entry) { return expired(entry.second); });
  if (sessions_.size() < limits_.most) return;
  sessions_.erase(std::min_element(sessions_.begin(), sessions_.end(), [](const auto& a, const auto& b) {
    return a.second.used < b.second.used;
  }));
}

}  // namespace stepwright::access
