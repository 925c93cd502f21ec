#pragma once

// A runtime id that no other process uses: whatever else runs on this machine in the same domain is not
// heard.

#include <unistd.h>

#include <string>

namespace stepwright::dds {

inline std::string test_runtime_id() {
  return "test-" + std::to_string(::getpid());
}

}  // namespace stepwright::dds
