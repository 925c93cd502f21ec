#pragma once

// A controller of a test's own: what the firmware is on a board, on the host's portable core. Programs,
// commands, turns, events; control_registers.h puts the registers of Modbus around it.
//
//   ControllerModel controller;
//   controller.begin_transfer(bytes, digest); controller.piece(0, container); controller.commit();
//   controller.start(true, false);
//   controller.turn(1, inputs);                 // one scan
//
// Threads: one.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "runtime/modbus/control/registers.h"
#include "runtime/scan/scan_cycle.h"

namespace stepwright::support {

namespace control = modbus::control;

struct ModelLimits {
  std::uint32_t max_program_bytes = 512 * 1024;
  std::uint32_t max_image_bytes = 64 * 1024;
  std::int64_t inputs_lost_after_ns = 500'000'000;
};

// What became of a command.
struct ModelAnswer {
  control::Refusal refusal = control::Refusal::Done;
  std::uint32_t detail = 0;
};

class ControllerModel {
 public:
  explicit ControllerModel(const ModelLimits& limits = {});
  ~ControllerModel();
  ControllerModel(ControllerModel&&) noexcept;
  ControllerModel& operator=(ControllerModel&&) noexcept;

  ModelAnswer start(bool lock_step, bool cold);
  ModelAnswer stop();
  ModelAnswer begin_transfer(std::uint32_t bytes, std::span<const std::byte> digest);
  // False if it leaves a gap, reaches beyond the end, or no transfer is under way.
  bool piece(std::uint32_t offset, std::span<const std::byte> bytes);
  ModelAnswer commit();
  ModelAnswer abort();
  ModelAnswer change_bits(control::Command command, std::uint32_t byte, std::uint64_t mask,
                          std::uint64_t value);

  // Inputs with their turn. In lock-step a new turn runs one scan; by the clock it is a sign of life.
  void turn(std::uint16_t number, std::span<const std::byte> inputs);
  // By the clock: everything that is due at `now_ns` of a clock that never goes back.
  void tick(std::int64_t now_ns);
  // When tick has something to do; below zero: it has not.
  std::int64_t next_tick_ns() const;
  // As by a loss of power: nothing but the program is left.
  void reset();

  control::State state() const { return state_; }
  std::uint16_t flags() const;
  std::uint64_t scan() const { return scan_; }
  std::int64_t time_ns() const { return time_ns_; }
  std::int64_t next_ns() const;
  std::uint64_t trace_hash() const { return trace_hash_; }
  std::uint64_t image_hash() const;
  const bytecode::Trap& trap() const { return trap_; }
  std::uint16_t newest_turn() const { return turn_; }
  std::uint32_t event() const { return event_; }
  control::Event event_kind() const { return event_kind_; }
  std::uint64_t event_scan() const { return event_scan_; }
  std::uint32_t transferred() const { return static_cast<std::uint32_t>(transfer_.size()); }
  std::span<const std::byte> program() const;
  std::span<const std::byte> digest() const { return digest_; }  // empty without a program
  std::span<const std::byte> image() const;
  std::span<const std::byte> event_image() const { return event_image_; }
  std::span<const std::byte> outputs() const;
  std::uint16_t input_bytes() const;
  std::uint32_t uptime_ms() const { return static_cast<std::uint32_t>(uptime_ns_ / 1'000'000); }
  const ModelLimits& limits() const { return limits_; }

 private:
  struct Machine;
  void scan_once();
  void note(control::Event kind);
  ModelAnswer install(std::vector<std::byte> container, std::vector<std::byte> digest);

  ModelLimits limits_;
  std::unique_ptr<Machine> machine_;
  control::State state_ = control::State::Empty;
  bool lock_step_ = false;
  bool transferring_ = false;
  bool inputs_lost_ = false;
  std::uint64_t scan_ = 0;
  std::int64_t time_ns_ = 0;
  std::int64_t next_start_ns_ = 0;
  std::uint64_t trace_hash_ = 0;
  bytecode::Trap trap_;
  std::uint16_t turn_ = 0;
  std::uint32_t event_ = 0;
  control::Event event_kind_ = control::Event::Started;
  std::uint64_t event_scan_ = 0;
  std::vector<std::byte> event_image_;
  std::vector<std::byte> digest_;
  std::vector<std::byte> transfer_;
  std::uint32_t transfer_bytes_ = 0;
  std::vector<std::byte> transfer_digest_;
  std::int64_t now_ns_ = 0;      // of the newest tick
  std::int64_t started_ns_ = 0;  // scan time 0 of this run by the clock, on the clock of tick
  std::int64_t heard_ns_ = 0;    // when the master was heard of last
  std::int64_t uptime_ns_ = 0;
  std::int64_t powered_ns_ = 0;
};

}  // namespace stepwright::support
