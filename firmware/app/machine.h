#pragma once

// The program of the controller with its memory: judged, loaded, started, scanned, stopped. Scan number, time
// and trace hash go on over programs, as those of a runtime on the host do.
//
// Called by the main loop only. No heap: everything a program needs comes from the board's memory.
//
//   Machine machine(memory, io, clock);
//   if (machine.judge(container).refusal == control::Refusal::Done) machine.load(digest);
//   machine.start({.lock_step = true});
//   machine.scan();

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/app/arena.h"
#include "firmware/app/events.h"
#include "firmware/app/limits.h"
#include "firmware/app/modbus_io.h"
#include "firmware/storage/sha256.h"
#include "runtime/image/image_bits.h"
#include "runtime/image/process_image.h"
#include "runtime/modbus/control/registers.h"
#include "runtime/scan/scan_cycle.h"
#include "runtime/vm/interpreter.h"

namespace stepwright::app {

struct Judgement {
  modbus::control::Refusal refusal = modbus::control::Refusal::Done;
  std::uint32_t detail = 0;
};

struct StartOptions {
  bool lock_step = false;
  std::int64_t now_ns = 0;              // of the clock; scans by the clock begin at it
  std::span<const std::byte> retained;  // what the retained variables have; empty: their initial values
};

struct ScanFigures {
  std::uint64_t scan = 0;
  std::int64_t time_ns = 0;  // scan clock of the newest scan
  std::uint64_t trace_hash = 0;
  std::uint64_t image_hash = 0;
  std::int64_t took_ns = 0;
  std::int64_t longest_ns = 0;
  std::uint64_t overruns = 0;
};

class Machine {
 public:
  Machine(std::span<std::byte> memory, ModbusIo& io, scan::Clock& clock);

  // Whether this controller can run the container. Runs the verifier in memory that is free; what is loaded
  // stays as it is. The bytes must stay where they are until another program is loaded.
  Judgement judge(std::span<const std::byte> container);
  // Of the container that was just judged.
  std::uint64_t judged_retain_bytes() const;
  // Requires a container that was just judged Done. Nothing may run.
  void load(const storage::Digest& digest);

  modbus::control::Refusal start(const StartOptions& options);
  modbus::control::Refusal stop();

  // One scan at next_time_ns(). Requires that it runs.
  void scan();
  // By the clock, at `now_ns` of the clock: whether a scan is due; overruns are settled.
  bool due(std::int64_t now_ns);
  // While nothing runs: fresh inputs, safe outputs.
  void idle();

  modbus::control::State state() const { return state_; }
  bool running() const { return state_ == modbus::control::State::Running; }
  bool lock_step() const { return lock_step_; }
  const bytecode::Program& program() const { return program_; }
  std::span<const std::byte> container() const { return container_; }
  const storage::Digest& digest() const { return digest_; }
  bytecode::Trap trap() const { return trap_; }
  ScanFigures figures() const;
  std::int64_t next_time_ns() const;
  const Events& events() const { return events_; }

  // Empty without a program.
  std::span<std::byte> image() { return image_ ? image_->bytes() : std::span<std::byte>(); }
  std::span<std::byte> inputs() { return image_ ? image_->inputs() : std::span<std::byte>(); }
  std::span<std::byte> outputs() { return image_ ? image_->outputs() : std::span<std::byte>(); }
  std::span<std::byte> markers() { return image_ ? image_->markers() : std::span<std::byte>(); }
  // Room for a copy of the retained values.
  std::span<std::byte> retain_copy() { return retain_copy_; }
  // Those whose time is over at `now_ns` of the clock are released.
  void end_forces(std::int64_t now_ns);
  image::ForceTable* forces() { return cycle_ ? &cycle_->forces() : nullptr; }

 private:
  void make_cycle(std::int64_t clock_origin_ns);
  void fault();

  Arena arena_;
  ModbusIo& io_;
  scan::Clock& clock_;
  std::span<const std::byte> container_;
  std::span<const std::byte> judged_bytes_;
  bytecode::Program judged_;
  bytecode::Program program_;
  storage::Digest digest_{};
  std::optional<vm::Interpreter> engine_;
  std::optional<image::ProcessImage> image_;
  std::optional<scan::ScanCycle> cycle_;
  std::span<std::byte> retain_copy_;
  std::array<std::byte, kMaxOutputBytes> safe_outputs_{};  // as they were driven last
  Events events_;
  modbus::control::State state_ = modbus::control::State::Empty;
  bool lock_step_ = false;
  std::int64_t origin_ns_ = 0;  // what the clock shows at scan time 0
  scan::StartPoint next_;       // of the next start
  bytecode::Trap trap_;
  ScanFigures figures_;
  std::uint64_t earlier_overruns_ = 0;
};

}  // namespace stepwright::app
