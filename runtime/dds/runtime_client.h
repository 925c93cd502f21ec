#pragma once

// Client of a runtime for supervisor and HMI, over Fast DDS and the link process.
//
//   auto client = RuntimeClient::connect({61, "supervisor", "bench"}, ClientRole::Supervisor);
//   if (!(*client)->wait_for_runtime(5s)) ...
//   auto digest = (*client)->download(container);
//   (*client)->start({.barrier = true});
//   while (auto event = (*client)->wait_event(1s)) (*client)->acknowledge(event->sequence);
//
// Threads: every function may be called from any thread; wait_event and wait_snapshot from one at a time
// each. Requests block until the runtime answered or `kRequestTimeout` passed, downloads up to
// `kDownloadTimeout`; they are resent meanwhile and carry ids, so that a link or a runtime that dies in
// between never performs one twice. Diagnostics: D0001 no runtime answers, D0003 the runtime's program
// arrived damaged, D0004 request out of bounds, D0005 Fast DDS could not start, D0006 an address that is none
// of this machine, D0008 the link is of another version: nothing was sent, D0009 another supervisor drives
// the runtime. Refusals of the runtime have its codes (runtime/service/requests.h), a refused container those
// of the verifier.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/dds/health.h"
#include "runtime/dds/types.h"
#include "runtime/ground/result/result.h"
#include "runtime/host/plant_fault.h"
#include "runtime/image/force_table.h"
#include "runtime/service/requests.h"

namespace stepwright::dds {

// Longer than a restart of the link process takes.
inline constexpr std::chrono::milliseconds kRequestTimeout{5'000};
// While the runtime lives, a container is on its way for so long at most: a gateway sends it over a serial
// line, at 9600 baud some 40 s for 32 KiB.
inline constexpr std::chrono::milliseconds kDownloadTimeout{180'000};

using service::kHeldByAnother;

// Result of a download.
struct Download {
  std::string digest;
  ChangeReport change;        // of an online change
  result::Diagnostics notes;  // what an online change carried, in words
};

class RuntimeClient {
 public:
  // Joins the domain; does not wait for anyone. Fails with D0005.
  [[nodiscard]] static result::Result<std::unique_ptr<RuntimeClient>> connect(const ParticipantConfig& config,
                                                                              ClientRole role);
  ~RuntimeClient();

  // True as soon as link and runtime are there and answer; false after `timeout`.
  [[nodiscard]] bool wait_for_runtime(std::chrono::milliseconds timeout);
  // Liveliness of the link and, behind it, of the runtime. Falls within 1 s of the death of either.
  bool runtime_alive() const;

  // Sends a container in chunks under its SHA-256 and puts it in place of the running program, which is
  // stopped first; the new one stays stopped. Returns the digest in hexadecimal. A refused or cut download
  // leaves what ran.
  [[nodiscard]] result::Result<std::string> download(std::span<const std::byte> container);
  // The same with a mode: an online change takes over from the running program between two scans.
  [[nodiscard]] result::Result<Download> download(std::span<const std::byte> container, DownloadMode mode);
  // Any request of runtime/service/requests.h; those below are shorter ways to say some of them. D0004 for a
  // write of no part or of more than host::kMaxBlockWrites, and for a name that is too long.
  [[nodiscard]] result::Result<service::Reply> ask(service::RequestBody body);
  // A supervisor has the runtime from now on, for as long as it lives; every other request of it asks for the
  // same. D0009 with who has it.
  [[nodiscard]] result::Result<void> claim();
  // Cold start of the loaded program. In simulated time the clock goes on from where it stands.
  [[nodiscard]] result::Result<void> start(const StartOptions& options);
  // Outputs to their safe state; `reason` (up to 200 bytes) comes back in the Stopped event.
  [[nodiscard]] result::Result<void> stop(const std::string& reason);
  // Lets the simulated clock go on past the barrier of this and every earlier event.
  [[nodiscard]] result::Result<void> acknowledge(std::uint64_t event_sequence);
  // What is forced in the runtime now, whoever has forced it.
  [[nodiscard]] result::Result<Forces> forces();
  // Faults of the simulated plant, with what holds now; none without one.
  [[nodiscard]] result::Result<std::vector<host::PlantFault>> faults();
  // The container that is loaded now: for a viewer or a restarted supervisor.
  [[nodiscard]] result::Result<std::vector<std::byte>> program();

  // The next event, in order; what got lost on the way is fetched again. A new client starts after the newest
  // event, or with it if the runtime waits for its acknowledgement; after a restart of the runtime it starts
  // anew.
  std::optional<StepEvent> wait_event(std::chrono::milliseconds timeout);
  // The newest of each, or none before the first arrived.
  std::optional<RuntimeStatus> status() const;
  std::optional<Snapshot> snapshot() const;
  // True as soon as a snapshot has come since this function returned last, false after `timeout`; from one
  // thread at a time.
  [[nodiscard]] bool wait_snapshot(std::chrono::milliseconds timeout);
  // About once a second; none from a link that does not publish it.
  std::optional<RuntimeHealth> health() const;
  // Samples received so far, by topic.
  std::vector<TopicTraffic> traffic() const;
  TopicTraffic snapshot_traffic() const;

 private:
  struct State;
  explicit RuntimeClient(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace stepwright::dds
