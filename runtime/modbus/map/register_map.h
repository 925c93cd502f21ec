#pragma once

// The tables of a Modbus slave over the image of one program: reads out of a snapshot, writes as parts of a
// host::BlockWrite, which the runtime carries out between two scans.
//
// Threads: immutable; any. No heap in reads and lookups: sorted flat tables, O(log segments + addresses).
//
//   auto map = RegisterMap::build(info, config);           // Built: the map, what is in it, what is wrong
//   reader.consistent([&](const host::SnapshotView& view) {
//     exception = map.read_registers(view, Table::HoldingRegisters, 0, 10, words);
//   });
//   exception = map.write_registers(100, 2, words, parts);
//
// Registers are big-endian (unless a range says otherwise), values wider than a register have their most
// significant register first (unless it says otherwise). A read or write may cover a part of a wide value. A
// value of one byte is widened to a register, with its sign if its type has one; what is written to it must
// fit, else exception 3. A BOOL in a register reads 0 or 1; any other number than 0 makes it TRUE.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/host/messages.h"
#include "runtime/host/snapshot_memory.h"
#include "runtime/modbus/map/segment.h"
#include "runtime/modbus/pdu/exception.h"

namespace stepwright::modbus::map {

using Parts = std::vector<host::ImageBits>;

class RegisterMap {
 public:
  using Segments = std::vector<Segment>;

  RegisterMap() = default;  // of no address
  // Requires segments that are sorted by address and do not overlap.
  explicit RegisterMap(std::array<Segments, kTables> tables) : tables_(std::move(tables)) {}

  // `packed` and `words` as pdu::DataModel has them; count >= 1, address + count <= 65536. Exception 2: an
  // address that stands for nothing; 4: the view holds a shorter image than the program's. Behind an
  // exception they hold anything.
  pdu::Exception read_bits(const host::SnapshotView& view, Table table, std::uint16_t address,
                           std::uint16_t count, std::span<std::byte> packed) const;
  pdu::Exception read_registers(const host::SnapshotView& view, Table table, std::uint16_t address,
                                std::uint16_t count, std::span<std::byte> words) const;

  // Append the parts. Exception 2: an address that stands for nothing or is not writable; 3: a value that
  // does not fit. Behind an exception `parts` holds a beginning, which is of no use.
  pdu::Exception write_coils(std::uint16_t address, std::uint16_t count, std::span<const std::byte> packed,
                             Parts& parts) const;
  pdu::Exception write_registers(std::uint16_t address, std::uint16_t count, std::span<const std::byte> words,
                                 Parts& parts) const;
  pdu::Exception mask_register(std::uint16_t address, std::uint16_t and_mask, std::uint16_t or_mask,
                               Parts& parts) const;
  // Whether all these addresses stand for something (of `table`), and may be written.
  bool covers(Table table, std::uint16_t address, std::uint16_t count) const;

  const Segments& segments(Table table) const { return tables_[static_cast<std::size_t>(table)]; }

 private:
  std::array<Segments, kTables> tables_;
};

}  // namespace stepwright::modbus::map
