#pragma once

// Refusal of a command that is one too many. Pure; any thread.

#include "runtime/ground/result/result.h"

namespace stepwright::host {

// The code by which a client knows that asking again helps.
inline constexpr const char* kBusy = "R0006";

inline tl::unexpected<result::Diagnostics> busy() {
  return result::fail(kBusy, {}, "the runtime is busy", "try again");
}

}  // namespace stepwright::host
