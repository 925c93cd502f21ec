#pragma once

// Memory that outlives a reset and a loss of power: pages that are erased to 0xFF and in which bits go from 1
// to 0 only. It is mapped: what is in it is read as memory.
//
// Called by the main loop only. A loss of power may come between any two bytes that are programmed or erased.

#include <cstddef>
#include <cstdint>
#include <span>

namespace stepwright::port {

class Flash {
 public:
  // Bytes of a page; a power of two, 256 at least. The memory is a whole number of pages.
  virtual std::uint32_t page_bytes() const = 0;

  // All of it.
  virtual std::span<const std::byte> content() const = 0;

  // The page that begins at `offset`, to 0xFF. False if it failed.
  virtual bool erase(std::uint32_t offset) = 0;

  // Requires a range within the memory. False if it failed: a bit that is 0 cannot become 1 again.
  virtual bool program(std::uint32_t offset, std::span<const std::byte> bytes) = 0;

 protected:
  ~Flash() = default;
};

}  // namespace stepwright::port
