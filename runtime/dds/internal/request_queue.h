#pragma once

// Requests on their way from Fast DDS to the runtime's service, as the bytes that they came as. It is
// bounded: what does not fit is dropped, and its sender asks again; but a stop finds room when nothing else
// does. A stop goes ahead of all that waits, up to the newest start: a start that was asked for before it
// must not come after it.
//
// Threads: one at a time; who has more brings a mutex.

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "runtime/service/requests.h"

namespace stepwright::dds::internal {

inline constexpr std::size_t kMaxQueuedRequests = 256;
inline constexpr std::size_t kRoomForStops = 64;  // besides

class RequestQueue {
 public:
  // `bytes` are the message (runtime/service/codec.h) of a request for `body`. False if it was dropped.
  bool push(const service::RequestBody& body, std::span<const std::byte> bytes);
  std::optional<std::vector<std::byte>> pop();

 private:
  struct Waiting {
    bool starts_or_stops = false;
    std::vector<std::byte> bytes;
  };
  std::deque<Waiting> waiting_;
};

}  // namespace stepwright::dds::internal
