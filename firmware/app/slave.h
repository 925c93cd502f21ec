#pragma once

// Data model of the firmware as a Modbus slave: the variables of the program below 0xF000, the controller
// from there on. A request lies in one of them; one that reaches from the one into the other is refused.
//
// Called by the main loop only. No heap.

#include "firmware/app/control_registers.h"
#include "firmware/app/program_map.h"
#include "runtime/modbus/pdu/data_model.h"

namespace stepwright::app {

class Slave final : public modbus::pdu::DataModel {
 public:
  explicit Slave(Controller& controller)
      : controller_(controller), registers_(controller), map_(controller.machine()) {}

  modbus::pdu::Exception read_bits(modbus::pdu::BitTable table, std::uint16_t address, std::uint16_t count,
                                   std::span<std::byte> packed) override;
  modbus::pdu::Exception read_registers(modbus::pdu::RegisterTable table, std::uint16_t address,
                                        std::uint16_t count, std::span<std::byte> words) override;
  modbus::pdu::Exception write_coils(std::uint16_t address, std::uint16_t count,
                                     std::span<const std::byte> packed) override;
  modbus::pdu::Exception write_registers(std::uint16_t address, std::uint16_t count,
                                         std::span<const std::byte> words) override;
  modbus::pdu::Exception mask_register(std::uint16_t address, std::uint16_t and_mask,
                                       std::uint16_t or_mask) override;
  modbus::pdu::Exception read_write_registers(const modbus::pdu::ReadWrite& what,
                                              std::span<std::byte> words) override;
  std::span<const std::byte> identification(std::uint8_t object) const override;

 private:
  modbus::pdu::Exception may_read(modbus::pdu::RegisterTable table, std::uint16_t address,
                                  std::uint16_t count);

  Controller& controller_;
  ControlRegisters registers_;
  ProgramMap map_;
};

}  // namespace stepwright::app
