#include "tests/unit/firmware/app/board_test.h"

namespace stepwright::test {
namespace {

// The image of kCounting: %IB0, then four bytes of outputs.
constexpr std::uint32_t kInput = 0;
constexpr std::uint32_t kOutput = 1;

class BitsTest : public BoardTest {
 protected:
  void SetUp() override { load_and_start(kCounting, control::kStartLockStep); }
};

TEST_F(BitsTest, Force_WhenSet_ThenHoldsOverInputsAndProgramUntilTaken) {
  EXPECT_TRUE(bits(Command::Force, kInput, 0x0F, 0x0A).refusal == Refusal::OutOfBounds)
      << "four bits are neither a bit nor bytes";
  EXPECT_TRUE(bits(Command::Force, kInput, 1u << 3, 1u << 3).done());
  EXPECT_EQ(controller.turn(bytes_of({0})).outputs[0], std::byte{8});
  EXPECT_TRUE(bits(Command::Force, kOutput, 0xFF, 0x55).done());
  EXPECT_EQ(controller.turn(bytes_of({0})).outputs[0], std::byte{0x55});
  EXPECT_TRUE(bits(Command::Unforce, kOutput, 0xFF, 0).done());
  EXPECT_TRUE(bits(Command::Unforce, kInput, 1u << 3, 0).done());
  EXPECT_EQ(controller.turn(bytes_of({3})).outputs[0], std::byte{3});
  EXPECT_EQ(bits(Command::Unforce, kInput, 1u << 3, 0).refusal, Refusal::NotForced);
}

TEST_F(BitsTest, Force_WhenProgramStartsAgain_ThenStays_WhenAnotherIsLoaded_ThenIsGone) {
  EXPECT_TRUE(bits(Command::Force, kInput, 0xFF, 7).done());
  controller.expect_done(Command::Stop);
  controller.start_lock_step();
  EXPECT_EQ(controller.turn(bytes_of({0})).outputs[0], std::byte{7});
  controller.download(compiled(kCounting));
  controller.start_lock_step();
  EXPECT_EQ(controller.turn(bytes_of({0})).outputs[0], std::byte{0});
}

// Its master may be gone by then.
TEST_F(BitsTest, Force_WhenItsTimeIsOver_ThenIsReleasedByTheController) {
  EXPECT_TRUE(bits(Command::Force, kInput, 0xFF, 7, 1'000).done());
  EXPECT_TRUE(bits(Command::Force, kOutput, 0xFF, 0x55, 0xFFFF'FFFF'FFFF'FFFF).done())
      << "longer than the clock lasts";
  EXPECT_EQ(controller.turn(bytes_of({0})).outputs[0], std::byte{0x55});
  EXPECT_EQ(board.machine().forces()->forces().size(), 2u);
  controller.expect_done(Command::Stop);
  board.run_ms(1'500);
  ASSERT_EQ(board.machine().forces()->forces().size(), 1u);
  EXPECT_EQ(board.machine().forces()->forces()[0].address, kOutput);
}

TEST_F(BitsTest, Bits_WhenOfAnotherProgram_ThenAreRefused) {
  const remote::ProgramDigest counting = controller.status().digest;
  controller.download(compiled("PROGRAM main VAR x : ARRAY[0..99] OF BYTE; END_VAR END_PROGRAM"));
  for (const Command code : {Command::WriteBits, Command::Force, Command::Unforce})
    EXPECT_EQ(bits_of(counting, code, 4, 0xFF, 1).refusal, Refusal::OtherProgram);
  EXPECT_TRUE(board.machine().forces()->forces().empty());
  EXPECT_EQ(controller.image()[4], std::byte{0});
  EXPECT_TRUE(bits(Command::WriteBits, 4, 0xFF, 1).done());
}

TEST_F(BitsTest, Bits_WhenBeyondTheImage_ThenAreRefused) {
  const std::uint32_t size = controller.status().image_bytes;
  for (const Command code : {Command::WriteBits, Command::Force, Command::Unforce}) {
    EXPECT_EQ(bits(code, size, 1, 1).refusal, Refusal::OutOfBounds);
    EXPECT_EQ(bits(code, size - 1, 0xFFFF, 1).refusal, Refusal::OutOfBounds);
    EXPECT_EQ(bits(code, 0xFFFF'FFFF, 1u << 8, 1).refusal, Refusal::OutOfBounds);
    EXPECT_EQ(bits(code, 0, 0, 1).refusal, Refusal::OutOfBounds);
  }
}

TEST_F(BitsTest, Force_WhenTheTableIsFull_ThenIsRefused) {
  controller.download(compiled("PROGRAM main VAR x : ARRAY[0..99] OF BYTE; END_VAR END_PROGRAM"));
  for (std::uint32_t i = 0; i < image::ForceTable::kCapacity; ++i)
    ASSERT_TRUE(bits(Command::Force, i, 0xFF, 1).done()) << i;
  EXPECT_EQ(bits(Command::Force, 90, 0xFF, 1).refusal, Refusal::ForcesFull);
  EXPECT_TRUE(bits(Command::Force, 0, 0xFF, 2).done()) << "one that is there";
}

TEST_F(BitsTest, Write_WhenAcrossBytes_ThenChangesTheMaskedBitsOnly) {
  controller.turn(bytes_of({0xFF}));
  EXPECT_TRUE(bits(Command::WriteBits, kOutput, 0x0FF0, 0x0AB0).done());
  const Bytes image = controller.image();
  EXPECT_EQ(image[kOutput], std::byte{0xBF});
  EXPECT_EQ(image[kOutput + 1], std::byte{0x0A});
}

}  // namespace
}  // namespace stepwright::test
