#pragma once

// Values that somebody forces upon variables while the program runs: written over inputs after they are read
// and over everything before the outputs are written. Bounded, so that it needs no heap. The end of a force
// stands beside it: it goes where the force goes, and needs nobody who remembers it.
// Thread rule: the scan thread only.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace stepwright::image {

inline constexpr std::uint8_t kWholeBytes = 0xFF;
inline constexpr std::int64_t kNoEnd = std::numeric_limits<std::int64_t>::max();

// A place in the image and what it is forced to.
struct Force {
  std::uint32_t address = 0;       // byte offset into the image
  std::uint8_t bit = kWholeBytes;  // 0..7: this bit only; `size` is 1 then
  std::uint8_t size = 1;           // bytes: 1, 2, 4 or 8
  std::uint64_t value = 0;         // little-endian in its lowest bytes
  std::int64_t end_ns = kNoEnd;    // by the clock of who owns the table: then it is released
};

class ForceTable {
 public:
  static constexpr std::size_t kCapacity = 64;

  // Adds a force, or replaces the one at the same place, its end too. False if it does not fit the image, is
  // malformed, or the table is full; nothing changes then.
  bool set(const Force& force, std::size_t image_size);

  // Ends the force at this place; false if there was none. The variable keeps its value.
  bool clear(std::uint32_t address, std::uint8_t bit);
  void clear_all() { count_ = 0; }

  // The instant at which the next force ends; kNoEnd: none does.
  std::int64_t next_end_ns() const;
  // Ends one force whose time is over, as `clear` does, and says which. False: there is none (any more).
  bool take_ended(std::int64_t now_ns, Force& ended);

  std::span<const Force> forces() const { return std::span(forces_).first(count_); }

  // Writes every force into the image that `set` checked against.
  void apply(std::span<std::byte> image) const;

 private:
  std::array<Force, kCapacity> forces_{};
  std::size_t count_ = 0;
};

}  // namespace stepwright::image
