#include "runtime/dds/internal/request_queue.h"

#include <algorithm>
#include <utility>

namespace stepwright::dds::internal {

bool RequestQueue::push(const service::RequestBody& body, std::span<const std::byte> bytes) {
  const bool stop = std::holds_alternative<service::Stop>(body);
  if (waiting_.size() >= kMaxQueuedRequests + (stop ? kRoomForStops : 0)) return false;
  Waiting request{stop || std::holds_alternative<service::Start>(body), {bytes.begin(), bytes.end()}};
  if (!stop) {
    waiting_.push_back(std::move(request));
    return true;
  }
  const auto newest = std::find_if(waiting_.rbegin(), waiting_.rend(),
                                   [](const Waiting& each) { return each.starts_or_stops; });
  waiting_.insert(newest.base(), std::move(request));
  return true;
}

std::optional<std::vector<std::byte>> RequestQueue::pop() {
  if (waiting_.empty()) return std::nullopt;
  std::vector<std::byte> bytes = std::move(waiting_.front().bytes);
  waiting_.pop_front();
  return bytes;
}

}  // namespace stepwright::dds::internal
