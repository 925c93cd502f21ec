#pragma once

// Interface of a runtime towards its service. HostRuntime implements it; the service's tests have one of
// their own.
//
// Threads: all of it belongs to one thread, the service's. Nothing blocks.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "runtime/host/command.h"
#include "runtime/host/messages.h"
#include "runtime/host/plant_fault.h"
#include "runtime/record/recorder.h"

namespace stepwright::host {

class RuntimePort {
 public:
  virtual ~RuntimePort() = default;

  // Verifies the container and has it take the place of the loaded one between two scans; the completion
  // carries `ticket`. A refused container changes nothing; it fails at once or completes with
  // Outcome::Refused and the problems. A start that is submitted later is performed later.
  [[nodiscard]] virtual result::Result<void> load(std::uint64_t ticket, std::vector<std::byte> container,
                                                  std::string digest) = 0;
  // The same beside the running program, which the new one takes over from between two scans; its values,
  // steps and forces go with it (runtime/doc/online_change.md). What is refused later, because of the steps
  // that are active then, comes with the completion. Requires a mode other than Replace.
  [[nodiscard]] virtual result::Result<void> change(std::uint64_t ticket, std::vector<std::byte> container,
                                                    std::string digest, DownloadMode mode) = 0;
  // Any command but Load and Change. False if too many are under way; then nothing happens.
  [[nodiscard]] virtual bool submit(const Command& command) = 0;
  // Writes all parts between two scans; the completion carries `ticket` and comes when snapshots show them.
  // Fails with R0006 if too many commands are under way.
  [[nodiscard]] virtual result::Result<void> write(std::uint64_t /*ticket*/, BlockWrite /*block*/) {
    return result::fail("R0002", {},
                        "this controller takes values one by one, and not many between the same two scans");
  }
  virtual std::optional<Completion> take_completion() = 0;
  // Events in the order of their sequence.
  virtual std::optional<StepEvent> take_event() = 0;

  virtual RuntimeStatus status() const = 0;
  // The container that is loaded; empty without one. Valid until the next completion is taken.
  virtual std::span<const std::byte> program() const = 0;

  // Readable when completions or events may be there; `clear` makes it unreadable until there are new ones.
  virtual int descriptor() const = 0;
  virtual void clear() = 0;
  // Of the shared snapshot memory, read-only.
  virtual int snapshot_descriptor() const = 0;

  // The forces, as of the newest completion, event or end of a force.
  virtual Forces forces() const { return {}; }
  // Faults of the simulated plant, with what holds now; none without one.
  virtual std::vector<PlantFault> faults() const { return {}; }
  // Begins a recording; the completion carries `ticket`. CommandKind::RecordEnd ends it. Fails with R0051 or
  // R0052, or R0006 if too many commands are under way.
  [[nodiscard]] virtual result::Result<void> record(std::uint64_t ticket,
                                                    const record::RecordingOptions& options) {
    static_cast<void>(ticket);
    return result::fail("R0052", {options.file.string(), 0, 0}, "this runtime does not record");
  }
  virtual record::RecordingStatus recording() const { return {}; }
};

}  // namespace stepwright::host
