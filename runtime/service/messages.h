#pragma once

// Every message that is exchanged with a runtime: on the service socket, in either direction, one per frame,
// and between the processes of its cell on Fast DDS, one per sample (link_messages.h). Plain values; any
// thread.
//
// On the socket a client begins with Hello and is answered with Welcome (which brings the descriptor of the
// snapshot memory). A client of another version is told the service's version in the Welcome, and nothing
// more. Then the client sends requests, and SupervisorLife if it stands for a supervisor; the service sends
// replies, every event from the sequence on that Hello named, and the status at least every kStatusPeriod.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "runtime/host/limits.h"
#include "runtime/host/messages.h"
#include "runtime/service/health.h"
#include "runtime/service/link_messages.h"
#include "runtime/service/requests.h"

namespace stepwright::service {

// Of the messages, wherever they travel: it changes with every change of a list of fields (codec.h) and of
// what a field means. Nobody reads a message of another version.
inline constexpr std::uint32_t kProtocolVersion = 11;
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

// In the order of their kinds on the wire. Those of the socket first; the others have no place there.
using Message = std::variant<Hello, Welcome, SupervisorLife, Request, Reply, host::StepEvent,
                             host::RuntimeStatus, LinkStatus, host::Snapshot, RuntimeHealth, Presence, Beacon,
                             OperatorRequest, OperatorAnswer>;

}  // namespace stepwright::service
