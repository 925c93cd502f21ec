#include "runtime/image/image_bits.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace stepwright::image {
namespace {

constexpr std::uint64_t kAll = ~std::uint64_t{0};

TEST(ImageBits, Write_WhenTheMaskCrossesBytes_ThenOnlyItsBitsChange) {
  std::vector<std::byte> image(4, std::byte{0xFF});
  EXPECT_EQ(write_bits(image, {1, 0x0FF0, 0x0AB0}), BitsStatus::Done);
  EXPECT_EQ(image, (std::vector{std::byte{0xFF}, std::byte{0xBF}, std::byte{0xFA}, std::byte{0xFF}}));
}

TEST(ImageBits, Write_WhenBeyondTheImage_ThenIsRefusedAndNothingChanges) {
  std::vector<std::byte> image(8, std::byte{0x11});
  const auto before = image;
  EXPECT_EQ(write_bits(image, {8, 0x01, 0x01}), BitsStatus::OutOfBounds);
  EXPECT_EQ(write_bits(image, {1, kAll, kAll}), BitsStatus::OutOfBounds);
  EXPECT_EQ(write_bits(image, {7, 0x0100, 0x0100}), BitsStatus::OutOfBounds);
  EXPECT_EQ(write_bits(image, {0xFFFF'FFFF, 0x0100, 0x0100}), BitsStatus::OutOfBounds) << "2^32 is not 0";
  EXPECT_EQ(write_bits(image, {0, 0, kAll}), BitsStatus::OutOfBounds) << "nothing to write";
  EXPECT_EQ(image, before);
}

TEST(ImageBits, ToForce_WhenTheMaskIsABitOrWholeBytes_ThenTheForceIsThatPlace) {
  Force force;
  ASSERT_EQ(to_force({2, 1u << 19, kAll}, 8, force), BitsStatus::Done);
  EXPECT_EQ(force.address, 4u);
  EXPECT_EQ(force.bit, 3);
  EXPECT_EQ(force.size, 1);
  EXPECT_EQ(force.value, 1u);
  for (const std::uint8_t size : std::array<std::uint8_t, 4>{1, 2, 4, 8}) {
    ASSERT_EQ(to_force({0, kAll >> (64 - 8 * size), kAll}, 8, force), BitsStatus::Done);
    EXPECT_EQ(force.bit, kWholeBytes);
    EXPECT_EQ(force.size, size);
    EXPECT_EQ(force.value, kAll >> (64 - 8 * size)) << "bits outside the mask are nobody's";
  }
}

TEST(ImageBits, ToForce_WhenTheMaskIsAnythingElse_ThenIsRefused) {
  Force force{.address = 5, .value = 9};
  for (const std::uint64_t mask : {std::uint64_t{0}, std::uint64_t{0x0F}, std::uint64_t{0x03},
                                   std::uint64_t{0xFF00}, std::uint64_t{0xFF'FFFF}, kAll - 1})
    EXPECT_EQ(to_force({0, mask, 1}, 8, force), BitsStatus::OutOfBounds) << mask;
  EXPECT_EQ(force.address, 5u);
  EXPECT_EQ(force.value, 9u);
}

// The bound is the image's own, whatever its size.
TEST(ImageBits, ToForce_WhenTheImageEnds_ThenTheLastBitIsTheLastOne) {
  Force force;
  for (const std::size_t size :
       {std::size_t{1}, std::size_t{8}, (std::size_t{1} << 20) + 8, std::size_t{0xFFFF'FFFF}}) {
    const auto last = static_cast<std::uint32_t>(size - 1);
    EXPECT_EQ(to_force({last, 0x80, 0x80}, size, force), BitsStatus::Done) << size;
    EXPECT_EQ(force.address, last);
    EXPECT_EQ(to_force({last, 0x100, 0x100}, size, force), BitsStatus::OutOfBounds) << size;
    EXPECT_EQ(to_force({last, 0xFFFF, 1}, size, force), BitsStatus::OutOfBounds) << size;
  }
  EXPECT_EQ(to_force({0xFFFF'FFFF, std::uint64_t{1} << 63, kAll}, 0xFFFF'FFFF, force),
            BitsStatus::OutOfBounds);
}

TEST(ImageBits, Forces_WhenSetAndCleared_ThenTheStatusSaysWhatBecameOfThem) {
  ForceTable forces;
  Force force;
  for (std::uint32_t i = 0; i < ForceTable::kCapacity; ++i) {
    ASSERT_EQ(to_force({i, 0xFF, i}, 100, force), BitsStatus::Done);
    EXPECT_EQ(set_force(forces, force, 100), BitsStatus::Done) << i;
  }
  EXPECT_EQ(set_force(forces, force, 100), BitsStatus::Done) << "one that is there";
  ASSERT_EQ(to_force({90, 0xFF, 1}, 100, force), BitsStatus::Done);
  EXPECT_EQ(set_force(forces, force, 100), BitsStatus::ForcesFull);
  EXPECT_EQ(clear_force(forces, force), BitsStatus::NotForced);
  ASSERT_EQ(to_force({0, 0xFF, 1}, 100, force), BitsStatus::Done);
  EXPECT_EQ(clear_force(forces, force), BitsStatus::Done);
  EXPECT_EQ(clear_force(forces, force), BitsStatus::NotForced);
}

TEST(ImageBits, BitsOf_WhenAForceIsMadeOfThem_ThenIsItsInverse) {
  const std::array<ImageBits, 5> each = {
      {{3, 0x01, 0x01}, {3, 0x80, 0}, {0, 0xFF, 0x5A}, {4, 0xFFFF'FFFF, 0x1234'5678}, {0, kAll, 77}}};
  for (const ImageBits& bits : each) {
    Force force;
    ASSERT_EQ(to_force(bits, 8, force), BitsStatus::Done);
    EXPECT_EQ(bits_of(force), bits);
  }
}

}  // namespace
}  // namespace stepwright::image
