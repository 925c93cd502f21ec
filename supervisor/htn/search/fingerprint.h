#pragma once

// 128 bits that stand for a state, a prefix of actions or a node of the search: two that differ have
// different ones, but for a chance of about n*n / 2^129 among n of them.
//
// Thread rule: plain values and pure functions.

#include <cstddef>
#include <cstdint>

namespace stepwright::htn {

struct Fingerprint {
  std::uint64_t high = 0;
  std::uint64_t low = 0;
  friend bool operator==(const Fingerprint&, const Fingerprint&) = default;
  Fingerprint& operator^=(const Fingerprint& other) {
    high ^= other.high;
    low ^= other.low;
    return *this;
  }
};

// The finaliser of splitmix64 (Steele, Lea, Flood 2014).
constexpr std::uint64_t scramble(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

// Of a number, for sets: `^` of their numbers' fingerprints.
constexpr Fingerprint fingerprint_of(std::uint64_t number) {
  return {scramble(2 * number), scramble(2 * number + 1)};
}

// Of a sequence that is one longer.
constexpr Fingerprint followed_by(Fingerprint prefix, std::uint64_t number) {
  return {scramble(prefix.high ^ scramble(2 * number)), scramble(prefix.low + scramble(2 * number + 1))};
}

struct FingerprintHash {
  std::size_t operator()(const Fingerprint& print) const { return static_cast<std::size_t>(print.high); }
};

}  // namespace stepwright::htn
