#pragma once

// Requests on their way from Fast DDS to the runtime's service. It is bounded: what does not fit is dropped,
// and its sender asks again; but a stop finds room when nothing else does. A stop goes ahead of all that
// waits, up to the newest start: a start that was asked for before it must not come after it.
//
// Threads: one at a time; who has more brings a mutex.

#include <cstddef>
#include <deque>
#include <optional>

#include "runtime/service/requests.h"

namespace stepwright::dds::internal {

inline constexpr std::size_t kMaxQueuedRequests = 256;
inline constexpr std::size_t kRoomForStops = 64;  // besides

class RequestQueue {
 public:
  // False if it was dropped.
  bool push(service::Request request);
  std::optional<service::Request> pop();

 private:
  std::deque<service::Request> waiting_;
};

}  // namespace stepwright::dds::internal
