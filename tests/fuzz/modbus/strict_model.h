#pragma once

// A model that takes the engine at its word: it touches every byte of what it is given, and aborts where the
// engine breaks what data_model.h promises.

#include "runtime/modbus/pdu/data_model.h"

namespace stepwright::fuzz::modbus {

class StrictModel final : public stepwright::modbus::pdu::DataModel {
 public:
  using Exception = stepwright::modbus::pdu::Exception;

  Exception read_bits(stepwright::modbus::pdu::BitTable table, std::uint16_t address, std::uint16_t count,
                      std::span<std::byte> packed) override;
  Exception read_registers(stepwright::modbus::pdu::RegisterTable table, std::uint16_t address,
                           std::uint16_t count, std::span<std::byte> words) override;
  Exception write_coils(std::uint16_t address, std::uint16_t count,
                        std::span<const std::byte> packed) override;
  Exception write_registers(std::uint16_t address, std::uint16_t count,
                            std::span<const std::byte> words) override;
  Exception mask_register(std::uint16_t address, std::uint16_t and_mask, std::uint16_t or_mask) override;
  Exception read_write_registers(const stepwright::modbus::pdu::ReadWrite& what,
                                 std::span<std::byte> words) override;
  std::span<const std::byte> identification(std::uint8_t object) const override;

  std::uint64_t calls() const { return calls_; }

 private:
  Exception answer(std::uint16_t address);

  std::uint64_t calls_ = 0;
  unsigned sum_ = 0;  // of all bytes that were written: they have been read
};

}  // namespace stepwright::fuzz::modbus
