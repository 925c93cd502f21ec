#pragma once

// Retained bytes of the image, which survive the process: the retain map of a program, sorted and joined, and
// the payload that a store keeps, the same bytes one behind the other.
//
// Threads: immutable; any. `gather` is for the scan thread: no heap, a copy per piece.
//
//   const RetainArea area = RetainArea::of(program);
//   std::vector<std::byte> payload(area.size());
//   area.gather(image.bytes(), payload);

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "runtime/bytecode/program.h"

namespace stepwright::record {

class StateLayout;

class RetainArea {
 public:
  RetainArea() = default;  // nothing is retained
  static RetainArea of(const bytecode::Program& program);

  // Bytes of the payload.
  std::uint32_t size() const { return size_; }
  // True if all these bytes of the image are retained; `count` at least 1.
  bool holds(std::uint32_t address, std::uint32_t count) const;
  // Where a byte of the image lies in the payload, if it is retained.
  std::optional<std::uint32_t> offset_of(std::uint32_t address) const;

  // Requires the image of the program and size() bytes of payload.
  void gather(std::span<const std::byte> image, std::span<std::byte> payload) const;

  // The retained variables of a layout that are no constants: with their places in the image, and with those
  // in the payload.
  StateLayout in_image(const StateLayout& layout) const;
  StateLayout in_payload(const StateLayout& layout) const;

 private:
  struct Piece {
    std::uint32_t address = 0;
    std::uint32_t size = 0;
    std::uint32_t offset = 0;  // in the payload
  };
  const Piece* piece_of(std::uint32_t address) const;

  std::vector<Piece> pieces_;  // by address, not touching each other
  std::uint32_t size_ = 0;
};

}  // namespace stepwright::record
