#pragma once

// A fast 64-bit hash for traces and image comparison: the same value on every little-endian machine.
// Not for untrusted keys: whoever picks the words can make two blocks collide.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace stepwright::base {

// Mixes one 64-bit word into a running hash (multiply and fold, as wyhash does).
constexpr std::uint64_t hash_mix(std::uint64_t hash, std::uint64_t word) {
  std::uint64_t x = (hash ^ word) * 0x9E3779B97F4A7C15ull;
  x ^= x >> 32;
  x *= 0xD6E8FEB86659FD93ull;
  return x ^ (x >> 29);
}

// Hash of a block of bytes, continued from `seed`.
inline std::uint64_t hash_bytes(std::span<const std::byte> bytes, std::uint64_t seed = 0) {
  std::uint64_t hash = hash_mix(seed, bytes.size());
  std::size_t i = 0;
  for (; i + 8 <= bytes.size(); i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, 8);
    hash = hash_mix(hash, word);
  }
  if (i < bytes.size()) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, bytes.size() - i);
    hash = hash_mix(hash, word);
  }
  return hash;
}

}  // namespace stepwright::base
