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

// The 8 bytes at `at`, little-endian; the missing ones of a shorter rest are zero.
inline std::uint64_t hash_word(const std::byte* at, std::size_t count = 8) {
  std::uint64_t word = 0;
  std::memcpy(&word, at, count);
  return word;
}

// Hash of a block of bytes, continued from `seed`. Four lanes run side by side over blocks of 32 bytes, so
// that the multiplications overlap. Blocks of equal size that differ in one 8-byte word only never collide.
inline std::uint64_t hash_bytes(std::span<const std::byte> bytes, std::uint64_t seed = 0) {
  std::uint64_t hash = hash_mix(seed, bytes.size());
  const std::byte* at = bytes.data();
  std::size_t left = bytes.size();
  if (left >= 32) {
    std::uint64_t a = hash, b = hash ^ 1, c = hash ^ 2, d = hash ^ 3;
    for (; left >= 32; left -= 32, at += 32) {
      a = hash_mix(a, hash_word(at));
      b = hash_mix(b, hash_word(at + 8));
      c = hash_mix(c, hash_word(at + 16));
      d = hash_mix(d, hash_word(at + 24));
    }
    hash = hash_mix(hash_mix(hash_mix(hash_mix(hash, a), b), c), d);
  }
  for (; left >= 8; left -= 8, at += 8) hash = hash_mix(hash, hash_word(at));
  if (left > 0) hash = hash_mix(hash, hash_word(at, left));
  return hash;
}

}  // namespace stepwright::base
