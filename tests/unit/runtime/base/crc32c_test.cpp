#include "runtime/base/crc32c.h"

#include <gtest/gtest.h>

#include <random>
#include <string_view>
#include <vector>

namespace stepwright::base {
namespace {

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text));
}

// The check value of the catalogue of CRCs, and the examples of RFC 3720, appendix B.4.
TEST(Crc32c, Sum_WhenTheBytesArePublished_ThenIsThePublishedOne) {
  std::vector<std::byte> counted(32);
  for (std::size_t i = 0; i < counted.size(); ++i) counted[i] = static_cast<std::byte>(i);
  const std::vector<std::byte> backwards(counted.rbegin(), counted.rend());
  for (const auto& sum : {crc32c, crc32c_bitwise}) {
    EXPECT_EQ(sum(bytes_of("123456789"), 0), 0xE3069283u);
    EXPECT_EQ(sum(std::vector(32, std::byte{0}), 0), 0x8A9136AAu);
    EXPECT_EQ(sum(std::vector(32, std::byte{0xFF}), 0), 0x62A8AB43u);
    EXPECT_EQ(sum(counted, 0), 0x46DD794Eu);
    EXPECT_EQ(sum(backwards, 0), 0x113FDB5Cu);
    EXPECT_EQ(sum({}, 0), 0u);
  }
}

TEST(Crc32c, Sum_WhenTakenInParts_ThenIsThatOfTheWhole) {
  const auto text = bytes_of("123456789");
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    EXPECT_EQ(crc32c(text.subspan(cut), crc32c(text.first(cut))), 0xE3069283u);
    EXPECT_EQ(crc32c_bitwise(text.subspan(cut), crc32c(text.first(cut))), 0xE3069283u);
  }
}

TEST(Crc32c, Sum_WhenBytesAreRandom_ThenBothSpeedsAgree) {
  std::mt19937 random(1);
  for (std::size_t size = 0; size < 300; ++size) {
    std::vector<std::byte> bytes(size);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
    const auto before = static_cast<std::uint32_t>(random());
    EXPECT_EQ(crc32c(bytes, before), crc32c_bitwise(bytes, before)) << size;
  }
}

}  // namespace
}  // namespace stepwright::base
