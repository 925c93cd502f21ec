#pragma once

// The names under which supervisor and HMI know what travels between them and a runtime. The meaning of every
// field stands in runtime/host/messages.h: Fast DDS carries it unchanged.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "runtime/ground/result/diagnostic.h"
#include "runtime/host/messages.h"

namespace stepwright::dds {

using host::BlockWrite;
using host::ChangeReport;
using host::DownloadMode;
using host::EventKind;
using host::ForceRequest;
using host::Forces;
using host::NamedValue;
using host::ProgramBits;
using host::RuntimeState;
using host::RuntimeStatus;
using host::Snapshot;
using host::StartOptions;
using host::StepEvent;

// A sample that was refused: of another version (D0008), malformed (R0005). Told from threads of Fast DDS, of
// one topic at most once a minute each.
using OnTrouble = std::function<void(const result::Diagnostic&)>;

// Where a process meets the others of its cell.
struct ParticipantConfig {
  std::uint32_t domain_id = 0;       // 0 to 232; every test its own
  std::string name;                  // of this process, for diagnostics: "supervisor"
  std::string runtime_id = "bench";  // the runtime it speaks to; several share a domain
  // IPv4 addresses of this machine that Fast DDS may use, and no others. Beyond loopback, participants also
  // find each other by multicast.
  std::vector<std::string> interfaces = {"127.0.0.1"};
  std::vector<std::string> peers = {};  // hosts to announce to where multicast does not reach
  // Where the runtime lives (machine and state folder): two of one name in a domain never meet, and are told
  // of each other. Empty: wherever it is.
  std::string place = {};
  // For the log of the process; what it uses outlives the participant.
  OnTrouble on_trouble = {};
};

enum class ClientRole : std::uint8_t {
  Supervisor,  // its liveliness counts for the runtime's lost-supervisor policy
  Viewer,
};

}  // namespace stepwright::dds
