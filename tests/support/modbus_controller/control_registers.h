#pragma once

// The registers of runtime/doc/modbus_controller.md around a ControllerModel, for the slave's engine.
// Threads: one. The model must outlive it.

#include <array>
#include <vector>

#include "runtime/modbus/pdu/data_model.h"
#include "tests/support/modbus_controller/controller_model.h"

namespace stepwright::support {

class ControlRegisters final : public modbus::pdu::DataModel {
 public:
  explicit ControlRegisters(ControllerModel& model) : model_(model) {}

  modbus::pdu::Exception read_bits(modbus::pdu::BitTable, std::uint16_t, std::uint16_t,
                                   std::span<std::byte>) override {
    return modbus::pdu::Exception::IllegalDataAddress;
  }
  modbus::pdu::Exception read_registers(modbus::pdu::RegisterTable table, std::uint16_t address,
                                        std::uint16_t count, std::span<std::byte> words) override;
  modbus::pdu::Exception write_coils(std::uint16_t, std::uint16_t, std::span<const std::byte>) override {
    return modbus::pdu::Exception::IllegalDataAddress;
  }
  modbus::pdu::Exception write_registers(std::uint16_t address, std::uint16_t count,
                                         std::span<const std::byte> words) override;
  modbus::pdu::Exception mask_register(std::uint16_t, std::uint16_t, std::uint16_t) override {
    return modbus::pdu::Exception::IllegalDataAddress;
  }
  modbus::pdu::Exception read_write_registers(const modbus::pdu::ReadWrite& what,
                                              std::span<std::byte> words) override;
  std::span<const std::byte> identification(std::uint8_t object) const override;

 private:
  void command(std::span<const std::uint16_t> words);
  ModelAnswer carry_out(control::Command code, std::span<const std::uint16_t> arguments);
  void fill_status(std::span<std::uint16_t> words) const;
  void fill_window(std::span<std::uint16_t> words) const;
  void fill_outputs(std::span<std::uint16_t> words) const;

  ControllerModel& model_;
  std::uint16_t number_ = 0;
  ModelAnswer answer_;
  control::Memory what_ = control::Memory::Image;
  std::uint32_t offset_ = 0;
};

}  // namespace stepwright::support
