#pragma once

// Requests of clients to a runtime's service, and the replies. Plain values; any thread.
//
// A request is named by (client, id): the client draws its number at random and counts its ids. A client
// without an answer sends the same request again; the service answers a repetition from memory and never
// performs it twice. So a link process can die and come back unnoticed.
//
// Diagnostics of the runtime: R0001 the socket, R0002 refused in the present state, R0003 a download that is
// broken, R0004 out of bounds, R0005 a malformed message, R0006 too busy, R0007 an unknown name,
// R0008 a start while the I/O does not answer, R0009 memory of another program than the one that is loaded,
// R0031 to R0038 online change (runtime/host/change_plan.h); a refused
// container brings the diagnostics of the verifier.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "runtime/ground/result/diagnostic.h"
#include "runtime/host/messages.h"
#include "runtime/service/answer_codes.h"

namespace stepwright::service {

using Sha256 = std::array<std::byte, 32>;

struct Start {
  bool barrier = false;
  bool cold = false;
};
struct Stop {
  std::string reason;
};
struct Acknowledge {
  std::uint64_t event = 0;
};
// These four name memory, and the program that it is of (host::ProgramBits): R0009 if another one is loaded
// when the scan thread comes to it. A repetition is answered from memory, or meets that check again.
struct Force {
  host::ForceRequest force;
};
struct Unforce {
  host::ProgramBits place;
};
struct Write {
  host::ProgramBits place;
};
// Many values between the same two scans, all of them or none; answered when snapshots show them.
struct WriteBlock {
  host::BlockWrite block;
};
struct InjectFault {
  std::string name;
  double value = 0.0;
};
// A download is begun, filled chunk by chunk in any order, and committed. A new begin drops what was there.
struct DownloadBegin {
  std::uint64_t total_bytes = 0;
  Sha256 digest{};
};
struct DownloadChunk {
  std::uint64_t offset = 0;
  std::vector<std::byte> data;
};
struct DownloadCommit {
  std::uint64_t total_bytes = 0;
  Sha256 digest{};
  host::DownloadMode mode = host::DownloadMode::Replace;
};
// The container that is loaded, up to kMaxChunkBytes from `offset`.
struct ReadProgram {
  std::uint64_t offset = 0;
};
// The configuration is read again: what can change at run time changes. Only on the service socket.
struct Reload {};
// Every event from this sequence on that the runtime still holds, sent again as events.
struct ResendEvents {
  std::uint64_t first = 1;
};

// The list of forces: Reply::data, see monitor_answers.h, in the program of Reply::digest. Observers may ask.
struct ReadForces {};
// Faults of the simulated plant from the given one on: Reply::data (monitor_answers.h), as many as fit;
// Reply::total_bytes says how many there are. Observers may ask.
struct ReadFaults {
  std::uint64_t first = 0;
};
// Simulated clock only: that many scans, then it stands still until the next Step or Continue; Reply::offset
// is the last of them. 0: stands still at once.
struct Step {
  std::uint64_t scans = 1;
};
struct Continue {};
// Records into a file that the runtime can write, until EndRecording.
struct BeginRecording {
  std::string file;             // absolute, up to kMaxPathBytes
  std::uint64_t max_bytes = 0;  // see record::RecordingOptions
  std::uint32_t hash_every = 1;
  std::uint32_t keyframe_every = 1'000;
};
struct EndRecording {};
// How the recording stands: Reply::data, see monitor_answers.h. Observers may ask.
struct ReadRecording {};

using RequestBody =
    std::variant<Start, Stop, Acknowledge, Force, Unforce, Write, InjectFault, DownloadBegin, DownloadChunk,
                 DownloadCommit, ReadProgram, ResendEvents, ReadForces, Step, Continue, BeginRecording,
                 EndRecording, ReadRecording, Reload, WriteBlock, ReadFaults>;

struct Request {
  std::uint64_t client = 0;
  std::uint64_t id = 0;
  RequestBody body;
  bool supervisor = false;  // of one that drives the runtime over Fast DDS: the link lets one at a time
};

// Accepted if no problem is an error.
struct Reply {
  std::uint64_t client = 0;
  std::uint64_t id = 0;
  result::Diagnostics problems;
  std::string digest;             // of the container committed or read, or of what is forced; hexadecimal
  std::uint64_t total_bytes = 0;  // of the container read
  std::uint64_t offset = 0;       // of `data` in it
  std::vector<std::byte> data;
  host::ChangeReport change = {};  // of an online change; notes among the problems name variables

  bool accepted() const { return !result::has_errors(problems); }
};

}  // namespace stepwright::service
