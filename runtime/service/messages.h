#pragma once

// Messages of the service socket, in either direction, one per frame. Plain values; any thread.
//
// A client begins with Hello and is answered with Welcome (which brings the descriptor of the snapshot
// memory). Whoever speaks another version is told that of the service by the Welcome, and nothing more. Then
// it sends requests, and SupervisorLife if it stands for a supervisor; the service sends replies, every event
// from the sequence on that Hello named, and the status at least every kStatusPeriod.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "runtime/host/limits.h"
#include "runtime/host/messages.h"
#include "runtime/service/requests.h"

namespace stepwright::service {

inline constexpr std::uint32_t kProtocolVersion = 7;
// Of one message without its frame: the largest event, or a reply full of diagnostics.
inline constexpr std::size_t kMaxMessageBytes = host::kMaxImageBytes + (64u << 10);
inline constexpr std::chrono::milliseconds kStatusPeriod{100};

enum class Role : std::uint8_t {
  Observer = 0,    // sees everything, changes nothing
  Controller = 1,  // may send every request
};

struct Hello {
  std::uint32_t version = kProtocolVersion;
  Role role = Role::Observer;
  std::uint64_t first_event = 0;  // 0: only events to come
  std::string name;               // of the process, for diagnostics; up to kMaxNameBytes
};

struct Welcome {
  std::uint32_t version = kProtocolVersion;
};

// From a Controller: whether a supervisor is alive behind it. Repeated at least every kStatusPeriod; its
// silence, or the end of its connection, counts as the supervisor's loss after the configured time. A start
// with a barrier and an acknowledgement are signs of life too.
struct SupervisorLife {
  bool alive = false;
};

using Message =
    std::variant<Hello, Welcome, SupervisorLife, Request, Reply, host::StepEvent, host::RuntimeStatus>;

}  // namespace stepwright::service
