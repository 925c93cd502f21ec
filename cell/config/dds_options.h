#pragma once

// Options of Fast DDS from a cell's configuration, for those of its processes that speak it. Pure; any
// thread.

#include <string>
#include <utility>

#include "cell/config/cell_config.h"
#include "runtime/dds/types.h"

namespace stepwright::config {

// `process` is for diagnostics; `runtime_id` is another runtime of the domain, or empty for the cell's own.
inline dds::ParticipantConfig participant_of(const DdsConfig& dds, std::string process,
                                             const std::string& runtime_id = {}) {
  const bool own = runtime_id.empty() || runtime_id == dds.runtime_id;
  return {dds.domain_id,  std::move(process), own ? dds.runtime_id : runtime_id,
          dds.interfaces, dds.peers,          own ? dds.place : std::string()};
}

}  // namespace stepwright::config
