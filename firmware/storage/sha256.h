#pragma once

// SHA-256 (FIPS 180-4), in pieces. Small rather than fast; no heap, any thread.
//
//   Sha256 sum;
//   sum.add(bytes);
//   const Digest digest = sum.finish();

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace stepwright::storage {

using Digest = std::array<std::byte, 32>;

class Sha256 {
 public:
  void add(std::span<const std::byte> bytes);
  // Nothing may be added after it.
  Digest finish();

 private:
  void block();
  void put(std::byte byte);

  std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<std::byte, 64> block_{};
  std::uint64_t bytes_ = 0;
};

Digest sha256(std::span<const std::byte> bytes);

}  // namespace stepwright::storage
