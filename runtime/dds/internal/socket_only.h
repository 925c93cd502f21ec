#pragma once

// The answer to a request that is for the socket of the runtime only. Pure; any thread.

#include "runtime/ground/result/result.h"

namespace stepwright::dds::internal {

inline tl::unexpected<result::Diagnostics> ask_on_the_socket() {
  return result::fail("R0002", {}, "this is asked on the socket of the runtime only",
                      "by somebody at its machine: over the network it is refused");
}

}  // namespace stepwright::dds::internal
