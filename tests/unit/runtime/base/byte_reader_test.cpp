#include "runtime/base/byte_reader.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace stepwright::base {
namespace {

constexpr std::array<std::byte, 6> kBytes = {std::byte{0x01}, std::byte{0x02}, std::byte{0x03},
                                             std::byte{0x04}, std::byte{0xFF}, std::byte{0xFE}};

TEST(ByteReader, Read_WhenBytesAreLeft_ThenGivesLittleEndianValues) {
  ByteReader reader(kBytes);
  EXPECT_EQ(reader.read<std::uint32_t>(), 0x04030201u);
  EXPECT_EQ(reader.read<std::int16_t>(), static_cast<std::int16_t>(0xFEFF));
  EXPECT_TRUE(reader.ok());
  EXPECT_TRUE(reader.at_end());
}

TEST(ByteReader, Read_WhenTooFewBytesAreLeft_ThenFailsForGood) {
  ByteReader reader(kBytes);
  EXPECT_EQ(reader.read<std::uint64_t>(), 0u);
  EXPECT_FALSE(reader.ok());
  EXPECT_EQ(reader.read<std::uint8_t>(), 0u);
  EXPECT_EQ(reader.position(), 0u);
}

TEST(ByteReader, ReadBytes_WhenTheCountIsHuge_ThenFailsWithoutOverflow) {
  ByteReader reader(kBytes);
  EXPECT_EQ(reader.read_bytes(2).size(), 2u);
  EXPECT_TRUE(reader.read_bytes(SIZE_MAX).empty());
  EXPECT_FALSE(reader.ok());
  EXPECT_EQ(reader.remaining(), 4u);
}

}  // namespace
}  // namespace stepwright::base
