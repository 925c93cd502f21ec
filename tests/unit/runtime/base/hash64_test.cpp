#include "runtime/base/hash64.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <set>
#include <vector>

namespace stepwright::base {
namespace {

std::vector<std::byte> pattern(std::size_t size) {
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(i * 7 + 3);
  return bytes;
}

// The value is part of the container format and of recorded traces: it may never change.
TEST(Hash64, HashBytes_WhenBytesAreKnown_ThenTheValueIsFixed) {
  EXPECT_EQ(hash_bytes({}), hash_mix(0, 0));
  const auto three = pattern(3);
  EXPECT_EQ(hash_bytes(three), hash_mix(hash_mix(0, 3), 0x110A03u));
  const auto forty = pattern(40);
  std::array<std::uint64_t, 4> lanes{};
  const std::uint64_t start = hash_mix(9, 40);
  for (std::uint64_t i = 0; i < 4; ++i) lanes[i] = hash_mix(start ^ i, hash_word(forty.data() + 8 * i));
  std::uint64_t expected = start;
  for (const std::uint64_t lane : lanes) expected = hash_mix(expected, lane);
  EXPECT_EQ(hash_bytes(forty, 9), hash_mix(expected, hash_word(forty.data() + 32)));
}

TEST(Hash64, HashBytes_WhenAnySingleBitDiffers_ThenTheHashDiffers) {
  auto bytes = pattern(75);
  const std::uint64_t original = hash_bytes(bytes);
  for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
    EXPECT_NE(hash_bytes(bytes), original) << "bit " << bit;
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
  }
}

TEST(Hash64, HashBytes_WhenOnlyTheLengthDiffers_ThenTheHashDiffers) {
  const std::vector<std::byte> zeros(100);
  std::set<std::uint64_t> hashes;
  for (std::size_t size = 0; size <= zeros.size(); ++size)
    hashes.insert(hash_bytes(std::span(zeros).first(size)));
  EXPECT_EQ(hashes.size(), zeros.size() + 1);
}

TEST(Hash64, HashBytes_WhenTheSeedDiffers_ThenTheHashDiffers) {
  const auto bytes = pattern(33);
  EXPECT_NE(hash_bytes(bytes, 1), hash_bytes(bytes, 2));
}

}  // namespace
}  // namespace stepwright::base
