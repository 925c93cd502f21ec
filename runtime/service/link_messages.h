#pragma once

// Messages between the link of a runtime and its clients on Fast DDS, beside those that the link passes on as
// they are (Reply, StepEvent). Plain values; any thread.

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

// A request on its way to the link.
struct SentRequest {
  Request request;
  bool supervisor = false;  // of one that drives the runtime: one at a time may
};

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

}  // namespace stepwright::service
