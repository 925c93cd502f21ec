#pragma once

// The names under which supervisor and HMI know what travels between them and a runtime. The meaning of every
// field stands in runtime/host/messages.h: Fast DDS carries it unchanged.

#include <cstdint>
#include <string>

#include "runtime/host/messages.h"

namespace stepwright::dds {

using host::ChangeReport;
using host::DownloadMode;
using host::EventKind;
using host::ForceRequest;
using host::NamedValue;
using host::RuntimeState;
using host::RuntimeStatus;
using host::Snapshot;
using host::StartOptions;
using host::StepEvent;
using host::UnforceRequest;
using host::WriteRequest;

// Where a process meets the others of its cell.
struct ParticipantConfig {
  std::uint32_t domain_id = 0;       // 0 to 232; every test its own
  std::string name;                  // of this process, for diagnostics: "supervisor"
  std::string runtime_id = "bench";  // the runtime it speaks to; several share a domain
};

enum class ClientRole : std::uint8_t {
  Supervisor,  // its liveliness counts for the runtime's lost-supervisor policy
  Viewer,
};

}  // namespace stepwright::dds
