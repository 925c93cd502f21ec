#pragma once

// Messages between the processes of a cell on Fast DDS, beside those that the link of a runtime passes on as
// they are (Request, Reply, StepEvent). Plain values; any thread.

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "runtime/host/messages.h"
#include "runtime/service/requests.h"

namespace stepwright::service {

// For people at the machine of the runtime: asked on its socket, never over the network.
inline bool is_for_the_socket_only(const RequestBody& body) {
  return std::holds_alternative<Step>(body) || std::holds_alternative<Continue>(body) ||
         std::holds_alternative<BeginRecording>(body) || std::holds_alternative<EndRecording>(body) ||
         std::holds_alternative<ReadRecording>(body) || std::holds_alternative<Reload>(body);
}

// The heartbeat of the link.
struct LinkStatus {
  host::RuntimeStatus status;
  bool runtime_connected = false;  // false: the link is there, the runtime behind it is not
};

// The heartbeat of the supervisor that holds the runtime, or wants to.
struct Presence {
  std::string process;       // as it calls itself
  std::uint64_t client = 0;  // as its requests say it
};

// Which runtime a link carries and where that lives: machine and state folder.
struct Beacon {
  std::string runtime_id;
  std::string place;
};

inline constexpr std::size_t kMaxOperatorRequestBytes = 64u << 10;
inline constexpr std::size_t kMaxOperatorProblems = 16;  // of one answer

// What a viewer asks of the cell's supervisor: a JSON text (supervisor/doc/plan_document.md).
struct OperatorRequest {
  std::string text;
  // Which one of whom: for the answer.
  std::uint64_t client = 0;
  std::uint64_t number = 0;
};

// What the supervisor says to the request of that number of that client; without problems it is accepted.
struct OperatorAnswer {
  std::uint64_t client = 0;
  std::uint64_t number = 0;
  result::Diagnostics problems;
};

}  // namespace stepwright::service
