#pragma once

// The controller as a mission sees it: a runtime that takes programs and sends step events. Over Fast DDS
// in the supervisor process (DdsController), in the same process in tests.
//
// Threads: one thread uses a controller; `alive` may be asked from any. Every call blocks until the runtime
// has answered.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "runtime/host/messages.h"

namespace stepwright::run {

// Whether the program that has caused the event does not run any more.
inline bool ends_program(host::EventKind kind) {
  return kind == host::EventKind::Trap || kind == host::EventKind::Stopped ||
         kind == host::EventKind::RolledBack;
}

class Controller {
 public:
  virtual ~Controller() = default;

  // Waits until a runtime is there and answers; false after `timeout`.
  virtual bool wait_for_runtime(std::chrono::milliseconds timeout) = 0;
  virtual bool alive() const = 0;

  // Puts a verified program in place of the running one, stopped. Returns its digest in hexadecimal.
  [[nodiscard]] virtual result::Result<std::string> download(std::span<const std::byte> container) = 0;
  // Has a verified program take over from the running one between two scans, without a stop: its charts begin
  // at their initial steps, what the old charts drove is off, variables of the same name and type keep their
  // values. Returns its digest. Fails where nothing runs or the change would be unsafe; then nothing happens.
  [[nodiscard]] virtual result::Result<std::string> change(std::span<const std::byte> container) = 0;
  // Starts it; with `barrier` the simulated clock stands still from each event until it is acknowledged.
  [[nodiscard]] virtual result::Result<void> start(bool barrier) = 0;
  // Outputs go to their safe state.
  [[nodiscard]] virtual result::Result<void> stop(const std::string& reason) = 0;
  [[nodiscard]] virtual result::Result<void> acknowledge(std::uint64_t event_sequence) = 0;
  // The container that is loaded now.
  [[nodiscard]] virtual result::Result<std::vector<std::byte>> program() = 0;

  virtual std::optional<host::StepEvent> wait_event(std::chrono::milliseconds timeout) = 0;
  // The newest of each, or none before the first arrived.
  virtual std::optional<host::RuntimeStatus> status() const = 0;
  virtual std::optional<host::Snapshot> snapshot() const = 0;
};

}  // namespace stepwright::run
