#pragma once

// The variables of the program as Modbus sees them below 0xF000: the map of OpenPLC, as far as the program
// has inputs, outputs and markers. What it does not have is IllegalDataAddress.
//
//   coils 0..8191             %QX0.0 .. %QX1023.7       discrete inputs 0..8191   %IX0.0 .. %IX1023.7
//   holding 0..1023           %QW0 ..                   input registers 0..1023   %IW0 ..
//   holding 1024..2047        %MW0 ..
//   holding 2048..4095        %MD0 ..  (2 registers)    the most significant register first
//   holding 4096..8191        %ML0 ..  (4 registers)
//
// Called by the main loop only. Requests are checked before anything changes.

#include <cstdint>
#include <span>

#include "firmware/app/machine.h"
#include "runtime/modbus/pdu/data_model.h"

namespace stepwright::app {

class ProgramMap {
 public:
  explicit ProgramMap(Machine& machine) : machine_(machine) {}

  modbus::pdu::Exception read_bits(modbus::pdu::BitTable table, std::uint16_t address, std::uint16_t count,
                                   std::span<std::byte> packed);
  modbus::pdu::Exception write_coils(std::uint16_t address, std::uint16_t count,
                                     std::span<const std::byte> packed);

  // Whether the program has all of these registers.
  bool has(modbus::pdu::RegisterTable table, std::uint16_t address, std::uint16_t count);
  // Require that it has them; `words` as on the wire.
  void read(modbus::pdu::RegisterTable table, std::uint16_t address, std::uint16_t count,
            std::span<std::byte> words);
  void write(std::uint16_t address, std::uint16_t count, std::span<const std::byte> words);

 private:
  // The bytes of one register: the low one first; one if the area ends within it, none if it does not exist.
  std::span<std::byte> cell(modbus::pdu::RegisterTable table, std::uint16_t address);

  Machine& machine_;
};

}  // namespace stepwright::app
