#pragma once

// Our own engine (pdu::serve) as a peer, over tables in memory.

#include "runtime/modbus/pdu/data_model.h"
#include "tests/unit/runtime/modbus/oracle/answer.h"
#include "tests/unit/runtime/modbus/oracle/tables.h"

namespace stepwright::modbus::oracle {

// A slave whose whole tables may be read and written.
class TableModel final : public pdu::DataModel {
 public:
  explicit TableModel(Tables& tables) : tables_(tables) {}

  pdu::Exception read_bits(pdu::BitTable table, std::uint16_t address, std::uint16_t count,
                           std::span<std::byte> packed) override;
  pdu::Exception read_registers(pdu::RegisterTable table, std::uint16_t address, std::uint16_t count,
                                std::span<std::byte> words) override;
  pdu::Exception write_coils(std::uint16_t address, std::uint16_t count,
                             std::span<const std::byte> packed) override;
  pdu::Exception write_registers(std::uint16_t address, std::uint16_t count,
                                 std::span<const std::byte> words) override;
  pdu::Exception mask_register(std::uint16_t address, std::uint16_t and_mask, std::uint16_t or_mask) override;
  pdu::Exception read_write_registers(const pdu::ReadWrite& what, std::span<std::byte> words) override;
  std::span<const std::byte> identification(std::uint8_t object) const override;

 private:
  Tables& tables_;
};

class OurPeer {
 public:
  explicit OurPeer(Sizes sizes) : initial_(sizes), tables_(sizes), model_(tables_) {}
  OurPeer(const OurPeer&) = delete;

  Answer ask(const Bytes& pdu);

 private:
  Tables initial_;
  Tables tables_;
  TableModel model_;
};

}  // namespace stepwright::modbus::oracle
