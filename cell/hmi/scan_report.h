#pragma once

// Answer of /api/scan about the runtimes that the server follows (hmi_web/doc/protocol.md, "Scan").
//
//   const std::string json =
//       scan_report({{.runtime = "bench", .own = true, .alive = true, .status = status}});
//
// Pure; any thread. What is not known is null, never a zero.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/dds/health.h"
#include "runtime/host/messages.h"

namespace stepwright::hmi {

struct FollowedRuntime {
  std::string runtime;  // its id
  bool own = false;     // of the cell that the page shows
  bool alive = false;
  std::optional<host::RuntimeStatus> status = {};  // the newest that came, if any did
  std::optional<dds::RuntimeHealth> health = {};
  std::vector<dds::TopicTraffic> traffic = {};
};

std::string scan_report(std::span<const FollowedRuntime> runtimes);

}  // namespace stepwright::hmi
