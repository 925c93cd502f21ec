#pragma once

// State of an online change in the scan thread, from one scan to the next.
//
// On trial are the first scans of a program that took over: until they have passed without a trap, the
// program before it stands by with its image as of the swap.
//
// Threads: the scan thread. Plain data; the pointers outlive the trial, as the service thread keeps both
// programs while ScanFigures names them.

#include <cstdint>

#include "runtime/host/command.h"

namespace stepwright::host {

class ChangePlan;

struct ChangeTrial {
  const ChangePlan* plan = nullptr;  // null: no trial
  std::uint32_t scans_left = 0;

  bool active() const { return plan != nullptr; }
};

// A change whose memory was brought near the processor in one pause between two scans; it is performed in the
// next one, before any later command.
struct WarmChange {
  Command command;
  bool waiting = false;
};

}  // namespace stepwright::host
