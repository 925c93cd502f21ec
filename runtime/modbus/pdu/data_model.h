#pragma once

// Interface to the tables of a slave: the protocol engine asks, the model answers with an exception code.
//
// A request is one call: it is carried out as a whole or not at all, so a model checks before it changes
// anything. Ranges arrive within 0 to 65536 and not empty; which of them exist only the model knows.
// Portable, no heap. Called by the thread that serves.

#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/modbus/pdu/exception.h"

namespace stepwright::modbus::pdu {

enum class BitTable : std::uint8_t { Coils, DiscreteInputs };
enum class RegisterTable : std::uint8_t { Holding, Input };

// FC 23: the write comes before the read (V1.1b3, 6.17).
struct ReadWrite {
  std::uint16_t read_address = 0;
  std::uint16_t read_count = 0;
  std::uint16_t write_address = 0;
  std::uint16_t write_count = 0;
  std::span<const std::byte> words;  // big-endian, write_count * 2 bytes
};

// Who the device is, for FC 43/14.
class Identity {
 public:
  // The text of an object of FC 43/14 (0 vendor, 1 product code, 2 revision, 3 URL, 4 product, 5 model, 6
  // application), at most 200 bytes of ASCII; empty: there is none. Objects 0 to 2 are mandatory.
  virtual std::span<const std::byte> identification(std::uint8_t object) const = 0;

 protected:
  ~Identity() = default;
};

class DataModel : public Identity {
 public:
  // `packed` has (count + 7) / 8 bytes: the first bit in bit 0 of the first byte; what is left over in the
  // last one must be 0.
  virtual Exception read_bits(BitTable table, std::uint16_t address, std::uint16_t count,
                              std::span<std::byte> packed) = 0;
  // `words` has count * 2 bytes, the most significant of each register first.
  virtual Exception read_registers(RegisterTable table, std::uint16_t address, std::uint16_t count,
                                   std::span<std::byte> words) = 0;
  virtual Exception write_coils(std::uint16_t address, std::uint16_t count,
                                std::span<const std::byte> packed) = 0;
  virtual Exception write_registers(std::uint16_t address, std::uint16_t count,
                                    std::span<const std::byte> words) = 0;
  virtual Exception mask_register(std::uint16_t address, std::uint16_t and_mask, std::uint16_t or_mask) = 0;
  virtual Exception read_write_registers(const ReadWrite& what, std::span<std::byte> words) = 0;

 protected:
  ~DataModel() = default;
};

// FC 22 (V1.1b3, 6.16).
constexpr std::uint16_t masked(std::uint16_t value, std::uint16_t and_mask, std::uint16_t or_mask) {
  return static_cast<std::uint16_t>((value & and_mask) | (or_mask & ~and_mask));
}

}  // namespace stepwright::modbus::pdu
