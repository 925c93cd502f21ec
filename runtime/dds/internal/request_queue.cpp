#include "runtime/dds/internal/request_queue.h"

#include <algorithm>
#include <utility>

namespace stepwright::dds::internal {

bool RequestQueue::push(service::Request request) {
  const bool stop = std::holds_alternative<service::Stop>(request.body);
  if (waiting_.size() >= kMaxQueuedRequests + (stop ? kRoomForStops : 0)) return false;
  if (!stop) {
    waiting_.push_back(std::move(request));
    return true;
  }
  const auto stays_ahead = [](const service::Request& each) {
    return std::holds_alternative<service::Start>(each.body) ||
           std::holds_alternative<service::Stop>(each.body);
  };
  const auto newest = std::find_if(waiting_.rbegin(), waiting_.rend(), stays_ahead);
  waiting_.insert(newest.base(), std::move(request));
  return true;
}

std::optional<service::Request> RequestQueue::pop() {
  if (waiting_.empty()) return std::nullopt;
  service::Request request = std::move(waiting_.front());
  waiting_.pop_front();
  return request;
}

}  // namespace stepwright::dds::internal
