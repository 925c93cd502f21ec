#pragma once

// The registers of the controller protocol, 0xF000 to 0xF2FF (runtime/doc/modbus_controller.md): which may be
// read and written how, and what that does.
//
// Called by the main loop only. No heap. Words are as on the wire: two bytes, the most significant first.

#include <cstdint>
#include <span>

#include "firmware/app/controller.h"
#include "firmware/app/status_block.h"
#include "runtime/modbus/pdu/exception.h"

namespace stepwright::app {

class ControlRegisters {
 public:
  explicit ControlRegisters(Controller& controller) : controller_(controller) {}

  static bool holds(std::uint16_t address) {
    return address >= modbus::control::kBegin && address < modbus::control::kEnd;
  }

  // Whether they may be read: within one block.
  static modbus::pdu::Exception may_read(std::uint16_t address, std::uint16_t count);
  // Requires that. `words` has count * 2 bytes.
  void read(std::uint16_t address, std::uint16_t count, std::span<std::byte> words);

  modbus::pdu::Exception write(std::uint16_t address, std::uint16_t count, std::span<const std::byte> words);

 private:
  modbus::pdu::Exception command(std::span<const std::uint16_t> words);
  modbus::pdu::Exception piece(std::span<const std::uint16_t> words);
  modbus::pdu::Exception select(std::span<const std::uint16_t> words);
  modbus::pdu::Exception inputs(std::span<const std::uint16_t> words);

  Controller& controller_;
  Selection selection_;
};

}  // namespace stepwright::app
