#include "runtime/dds/internal/request_table.h"

#include <utility>

namespace stepwright::dds::internal {

service::Request RequestTable::open(service::RequestBody body) {
  const std::scoped_lock lock(mutex_);
  const std::uint64_t id = ++last_id_;
  open_.emplace(id, std::nullopt);
  return {client_, id, std::move(body), supervisor_};
}

void RequestTable::answer(service::Reply reply) {
  if (reply.client != client_) return;
  {
    const std::scoped_lock lock(mutex_);
    const auto found = open_.find(reply.id);
    if (found == open_.end() || found->second) return;
    found->second = std::move(reply);
  }
  answered_.notify_all();
}

std::optional<service::Reply> RequestTable::wait(std::uint64_t id, std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  answered_.wait_for(lock, timeout, [&] {
    const auto found = open_.find(id);
    return found == open_.end() || found->second.has_value();
  });
  const auto found = open_.find(id);
  return found == open_.end() ? std::nullopt : found->second;
}

void RequestTable::forget(std::uint64_t id) {
  const std::scoped_lock lock(mutex_);
  open_.erase(id);
}

}  // namespace stepwright::dds::internal
