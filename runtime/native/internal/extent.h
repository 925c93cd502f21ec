#pragma once

// Extent of an access: the bytes that it can touch, as far as it is known when the code is made. Plain
// values.

#include <cstdint>

namespace stepwright::native {

// Base of an address; the image is all of the memory here, frames included. Slots are the context and the
// functions' locals and operands: no Ref reaches them.
enum class Space : std::uint8_t { Image, Instance, Slot, Unknown };

// Beyond this no address is followed: sums of it stay far from wrapping around.
inline constexpr std::uint64_t kFarthest = std::uint64_t{1} << 40;

struct Extent {
  Space space = Space::Unknown;
  std::uint64_t first = 0;
  std::uint64_t end = 0;  // one behind the last byte

  // The same extent this much further and longer; unknown if that leads too far.
  constexpr Extent moved(std::uint64_t offset, std::uint64_t longer) const {
    if (space == Space::Unknown || offset > kFarthest || longer > kFarthest) return {};
    const Extent out{space, first + offset, end + offset + longer};
    return out.end > kFarthest ? Extent{} : out;
  }

  // So many bytes at one place: no access of that size within the extent lies anywhere else.
  constexpr bool is_place_of(std::uint64_t bytes) const {
    return space != Space::Unknown && end - first == bytes;
  }

  friend bool operator==(const Extent&, const Extent&) = default;
};

// Where the instances that a function runs on lie in the memory: from the lowest to the highest.
struct InstanceRange {
  std::uint64_t lowest = ~std::uint64_t{0};
  std::uint64_t highest = 0;

  constexpr bool empty() const { return lowest > highest; }
  constexpr bool single() const { return lowest == highest; }
  void add(std::uint64_t low, std::uint64_t high) {
    if (low < lowest) lowest = low;
    if (high > highest) highest = high;
  }
};

// Where a function finds its slots and its instance.
struct FunctionPlaces {
  InstanceRange instances;       // empty: nothing calls it, or it has no instance
  InstanceRange frames;          // where its own frames lie in the memory, one for each task that reaches it
  std::uint32_t first_slot = 0;  // locals, then operands, then the saved instance; bytes behind the context

  // Bytes of the running instance; of the image, where it is always the same one.
  constexpr Extent own(std::uint32_t offset, std::uint32_t bytes) const {
    if (!instances.single()) return {Space::Instance, offset, std::uint64_t{offset} + bytes};
    return {Space::Image, instances.lowest + offset, instances.lowest + offset + bytes};
  }

  // The byte of the function's frame, whichever task runs it.
  constexpr Extent framed(std::uint32_t offset) const {
    if (frames.empty()) return {Space::Image, offset, offset};
    return {Space::Image, frames.lowest + offset, frames.highest + offset};
  }
};

constexpr bool intersect(std::uint64_t a, std::uint64_t a_end, std::uint64_t b, std::uint64_t b_end) {
  return a < b_end && b < a_end;
}

// False only if the two never share a byte in a function that runs on these instances.
constexpr bool may_overlap(const Extent& a, const Extent& b, const InstanceRange& instances) {
  if (a.space == Space::Slot || b.space == Space::Slot) {
    return a.space == b.space && intersect(a.first, a.end, b.first, b.end);
  }
  if (a.space == Space::Unknown || b.space == Space::Unknown) return true;
  if (a.space == b.space) return intersect(a.first, a.end, b.first, b.end);
  const Extent& own = a.space == Space::Instance ? a : b;
  const Extent& fixed = a.space == Space::Instance ? b : a;
  return intersect(instances.lowest + own.first, instances.highest + own.end, fixed.first, fixed.end);
}

}  // namespace stepwright::native
