#include "runtime/image/process_image.h"

#include <gtest/gtest.h>

#include <vector>

namespace stepwright::image {
namespace {

constexpr ImageLayout kLayout{.inputs = 4, .outputs = 2, .markers = 3, .data = 7};

TEST(ProcessImage, Areas_WhenLaidOut_ThenFollowEachOther) {
  std::vector<std::byte> memory(kLayout.size());
  ProcessImage image(memory, kLayout);
  EXPECT_EQ(image.inputs().data(), memory.data());
  EXPECT_EQ(image.outputs().data(), memory.data() + 4);
  EXPECT_EQ(image.markers().data(), memory.data() + 6);
  EXPECT_EQ(image.data().data(), memory.data() + 9);
  EXPECT_EQ(image.inputs().size() + image.outputs().size() + image.markers().size() + image.data().size(),
            memory.size());
}

TEST(ProcessImage, Reset_WhenInitialDataIsShorter_ThenTheRestIsZero) {
  std::vector<std::byte> memory(kLayout.size(), std::byte{0xAA});
  ProcessImage image(memory, kLayout);
  const std::vector<std::byte> initial(5, std::byte{1});
  image.reset(initial);
  EXPECT_EQ(memory[4], std::byte{1});
  EXPECT_EQ(memory[5], std::byte{0});
  EXPECT_EQ(memory.back(), std::byte{0});
  image.reset({});
  EXPECT_EQ(memory[0], std::byte{0});
}

TEST(ProcessImage, Hash_WhenAByteOfAnyAreaChanges_ThenChanges) {
  std::vector<std::byte> memory(kLayout.size());
  ProcessImage image(memory, kLayout);
  const std::uint64_t before = image.hash();
  for (std::byte& byte : memory) {
    byte = std::byte{1};
    EXPECT_NE(image.hash(), before);
    byte = std::byte{0};
  }
  EXPECT_EQ(image.hash(), before);
}

TEST(ProcessImage, Bits_WhenSet_ThenTheOthersStay) {
  std::vector<std::byte> area(2, std::byte{0x0F});
  set_bit(area, 1, 7, true);
  set_bit(area, 1, 0, false);
  EXPECT_EQ(area[1], std::byte{0x8E});
  EXPECT_EQ(area[0], std::byte{0x0F});
  EXPECT_TRUE(get_bit(area, 1, 7));
  EXPECT_FALSE(get_bit(area, 1, 0));
}

}  // namespace
}  // namespace stepwright::image
