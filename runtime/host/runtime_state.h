#pragma once

// The states of a runtime and the kinds of events it reports, shared by host, service and everything behind
// them. The numbers are part of the service protocol and of the DDS types: append, never renumber.

#include <cstdint>

namespace stepwright::host {

enum class RuntimeState : std::uint8_t {
  Empty = 0,    // no program loaded
  Stopped = 1,  // program loaded, not scanned; outputs in their safe state
  Running = 2,  // scanning (or standing still at a barrier of simulated time)
  Fault = 3,    // stopped by a trap or by lost I/O; outputs in their safe state; leaves by download or start
};

enum class EventKind : std::uint8_t {
  Started = 0,     // the image holds initial and, unless it is a cold start, retained values; no scan has run
  StepChange = 1,  // at least one step bit changed in this scan
  Stopped = 2,     // by command, by a download or because the supervisor was lost (see the detail)
  Trap = 3,        // a program fault or lost I/O (see the detail)
  Changed = 4,     // an online change: the image is that of the new program before its first scan
  RolledBack = 5,  // the new program trapped in its first scans; the old one goes on (see the detail)
};

// Details of events, for people; who decides looks at the cause. The policy for a lost supervisor stopped the
// program:
inline constexpr const char* kSupervisorLost = "the supervisor was lost";

// Nothing that a program did:
inline constexpr const char* kStoodStill =
    "the runtime stood still: its outputs were taken for lost and stay safe until a start";
inline constexpr const char* kIoLost = "the I/O driver does not answer";

}  // namespace stepwright::host
