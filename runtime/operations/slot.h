#pragma once

// Slot of the stack: 64 bits that hold a typed value. Bool is 0 or 1, I32 and F32 lie in the low half with a
// zero high half, a Ref is its offset.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace stepwright::operations {

using Slot = std::uint64_t;

template <typename T>
inline T from_slot(Slot slot);
template <>
inline bool from_slot<bool>(Slot slot) {
  return slot != 0;
}
template <>
inline std::int32_t from_slot<std::int32_t>(Slot slot) {
  return static_cast<std::int32_t>(slot);
}
template <>
inline std::uint32_t from_slot<std::uint32_t>(Slot slot) {
  return static_cast<std::uint32_t>(slot);
}
template <>
inline std::int64_t from_slot<std::int64_t>(Slot slot) {
  return static_cast<std::int64_t>(slot);
}
template <>
inline std::uint64_t from_slot<std::uint64_t>(Slot slot) {
  return slot;
}
template <>
inline float from_slot<float>(Slot slot) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(slot));
}
template <>
inline double from_slot<double>(Slot slot) {
  return std::bit_cast<double>(slot);
}

inline Slot to_slot(bool value) {
  return value ? 1 : 0;
}
inline Slot to_slot(std::int32_t value) {
  return static_cast<std::uint32_t>(value);
}
inline Slot to_slot(std::uint32_t value) {
  return value;
}
inline Slot to_slot(std::int64_t value) {
  return static_cast<Slot>(value);
}
inline Slot to_slot(std::uint64_t value) {
  return value;
}
inline Slot to_slot(float value) {
  return std::bit_cast<std::uint32_t>(value);
}
inline Slot to_slot(double value) {
  return std::bit_cast<Slot>(value);
}

// An unaligned little-endian value.
template <typename T>
inline T read_as(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof(T));
  return value;
}
template <typename T>
inline void write_as(std::byte* at, T value) {
  std::memcpy(at, &value, sizeof(T));
}

}  // namespace stepwright::operations
