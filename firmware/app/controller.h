#pragma once

// The controller: a program in two slots, its scans, its retained values, and the commands that a master
// gives. Modbus is in front of it (slave.h), the board behind it.
//
// Called by the main loop only. No heap. Commands are carried out in work(), between two scans and after
// their answer is on its way; one that takes long in steps, between which the line is served.
//
//   Controller controller(board);
//   controller.boot();
//   for (;;) { ... serve what the line brings ...; controller.work(); }

#include <array>
#include <cstdint>
#include <span>

#include "firmware/app/machine.h"
#include "firmware/app/modbus_io.h"
#include "firmware/app/transfer.h"
#include "firmware/port/board.h"
#include "firmware/storage/program_store.h"
#include "firmware/storage/retain_store.h"
#include "runtime/modbus/pdu/exception.h"
#include "runtime/scan/clock.h"

namespace stepwright::app {

// A command as it was written: code and arguments.
struct CommandWords {
  std::uint16_t number = 0;
  std::uint16_t count = 0;  // of words, the number and the code among them
  std::array<std::uint16_t, modbus::control::command::kMaxCount> words{};
};

struct CommandAnswer {
  std::uint16_t number = 0;
  Judgement result;
};

class Controller {
 public:
  explicit Controller(port::Board& board);

  // Loads the newest program that is whole and fits.
  void boot();

  // The command waiting, a scan that is due, retained values. False if there was nothing to do.
  bool work();

  // Takes a command to be carried out. A repetition of the newest is ignored; DeviceBusy while one waits.
  modbus::pdu::Exception submit(const CommandWords& command);
  modbus::pdu::Exception piece(std::uint32_t offset, std::span<const std::byte> bytes) {
    return transfer_.piece(offset, bytes);
  }

  // The inputs block: in lock-step a new turn lets one scan run before this returns.
  void exchange(std::uint16_t turn, std::span<const std::byte> inputs);
  std::uint16_t turn() const { return turn_; }

  // After somebody wrote into the image from outside: outputs stay safe while nothing runs.
  void touched();

  Machine& machine() { return machine_; }
  const Transfer& transfer() const { return transfer_; }
  const CommandAnswer& answer() const { return answer_; }
  std::uint16_t flags() const;
  std::uint32_t max_program_bytes() const { return store_.capacity(); }
  std::uint32_t max_image_bytes() const { return static_cast<std::uint32_t>(board_.memory.size()); }
  int slot() const { return slot_; }
  std::uint32_t uptime_ms() { return static_cast<std::uint32_t>(board_.tick.now_ns() / 1'000'000); }
  std::uint16_t resets() const { return board_.watchdog.resets(); }
  const char* board_name() const { return board_.name; }

 private:
  // The clock that measures scans is the board's.
  struct BoardClock final : scan::Clock {
    explicit BoardClock(port::Tick& tick) : tick_(tick) {}
    std::int64_t now_ns() override { return tick_.now_ns(); }
    port::Tick& tick_;
  };

  bool prepared(const CommandWords& command);
  Judgement carry_out(const CommandWords& command);
  Judgement start(std::uint16_t flags);
  Judgement stop();
  Judgement begin_transfer(const CommandWords& command);
  Judgement commit();
  Judgement bits(modbus::control::Command code, const CommandWords& command);
  Judgement clear_retained();
  Judgement judge(std::span<const std::byte> container);
  void scan_by_clock(std::int64_t now_ns);
  void keep_retained(bool now);

  port::Board& board_;
  BoardClock clock_;
  ModbusIo io_;
  storage::ProgramStore store_;
  storage::RetainStore retain_;
  Machine machine_;
  Transfer transfer_;
  int slot_ = -1;
  std::uint16_t turn_ = 0;
  CommandWords waiting_;
  bool command_waits_ = false;
  CommandAnswer answer_;
  bool inputs_lost_ = false;  // why it is in the state Fault
  bool retain_restored_ = false;
  bool retain_asked_ = false;       // values are to be written although nothing runs any more
  std::int64_t retain_due_ns_ = 0;  // when changed values may be written again
  std::int64_t sign_of_life_ns_ = 0;
};

}  // namespace stepwright::app
