#include "tests/unit/firmware/app/board_test.h"

namespace stepwright::test {
namespace {

constexpr int kIllegalAddress = 2;

class ProgramMapTest : public BoardTest {
 protected:
  void SetUp() override { load_and_start(kCounting, control::kStartLockStep); }
};

TEST_F(ProgramMapTest, Bits_WhenOfTheProgram_ThenAreItsInputsAndOutputs) {
  controller.turn(bytes_of({0b1010'0101}));
  EXPECT_EQ(line.ask(bytes_of({1, 0, 0, 0, 8})), bytes_of({1, 1, 0b1010'0101}));
  EXPECT_EQ(line.ask(bytes_of({2, 0, 2, 0, 4})), bytes_of({2, 1, 0b1001}));
  EXPECT_EQ(exception_of(bytes_of({1, 0, 31, 0, 1})), 0) << "%QX3.7";
  EXPECT_EQ(exception_of(bytes_of({1, 0, 32, 0, 1})), kIllegalAddress);
  EXPECT_EQ(exception_of(bytes_of({2, 0, 1, 0, 8})), kIllegalAddress);
}

TEST_F(ProgramMapTest, Coils_WhenWrittenWhileItRuns_ThenChangeUntilTheProgramWritesThem) {
  EXPECT_EQ(exception_of(bytes_of({15, 0, 1, 0, 3, 1, 0b101})), 0);
  EXPECT_EQ(line.ask(bytes_of({1, 0, 0, 0, 8})), bytes_of({1, 1, 0b1010}));
  controller.turn(bytes_of({0}));
  EXPECT_EQ(line.ask(bytes_of({1, 0, 0, 0, 8})), bytes_of({1, 1, 0}));
}

TEST_F(ProgramMapTest, Registers_WhenOfTheProgram_ThenLittleEndianBytesAreWords) {
  controller.turn(bytes_of({7}));
  controller.turn(bytes_of({7}));
  EXPECT_EQ(line.ask(bytes_of({3, 0, 0, 0, 2})), bytes_of({3, 4, 0, 7, 0, 2})) << "%QW0, %QW1";
  EXPECT_EQ(line.ask(bytes_of({4, 0, 0, 0, 1})), bytes_of({4, 2, 0, 7})) << "%IW0 of one byte";
  EXPECT_EQ(exception_of(bytes_of({4, 0, 1, 0, 1})), kIllegalAddress);
  EXPECT_EQ(exception_of(bytes_of({3, 0, 2, 0, 1})), kIllegalAddress);
}

// Markers: %MW0 at byte 0, %MD1 at 4, %ML1 at 8.
TEST_F(ProgramMapTest, Markers_WhenWrittenByOneWidth_ThenAreReadByTheOthers) {
  EXPECT_EQ(exception_of(bytes_of({16, 0x10, 4, 0, 4, 8, 1, 2, 3, 4, 5, 6, 7, 8})), 0) << "%ML1";
  EXPECT_EQ(line.ask(bytes_of({3, 0x10, 4, 0, 4})), bytes_of({3, 8, 1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(line.ask(bytes_of({3, 8, 4, 0, 4})), bytes_of({3, 8, 5, 6, 7, 8, 1, 2, 3, 4})) << "%MD2, %MD3";
  EXPECT_EQ(line.ask(bytes_of({3, 4, 4, 0, 4})), bytes_of({3, 8, 7, 8, 5, 6, 3, 4, 1, 2})) << "%MW4 to 7";
  EXPECT_EQ(exception_of(bytes_of({6, 4, 0, 0x12, 0x34})), 0) << "%MW0";
  EXPECT_EQ(exception_of(bytes_of({22, 4, 0, 0x0F, 0x0F, 0x50, 0x50})), 0) << "FC 22";
  EXPECT_EQ(line.ask(bytes_of({3, 4, 0, 0, 1})), bytes_of({3, 2, 0x52, 0x54}));
  EXPECT_EQ(exception_of(bytes_of({3, 4, 8, 0, 1})), kIllegalAddress) << "%MW8 does not exist";
}

TEST_F(ProgramMapTest, ReadWrite_WhenOfMarkersAndController_ThenIsOneRequest) {
  EXPECT_EQ(line.ask(bytes_of({23, 0xF0, 0, 0, 1, 4, 0, 0, 1, 2, 0, 9})), bytes_of({23, 2, 0x53, 0x57}));
  EXPECT_EQ(line.ask(bytes_of({3, 4, 0, 0, 1})), bytes_of({3, 2, 0, 9}));
}

TEST_F(ProgramMapTest, Write_WhenItReachesBeyond_ThenChangesNothing) {
  EXPECT_EQ(exception_of(bytes_of({16, 4, 7, 0, 2, 4, 0, 1, 0, 1})), kIllegalAddress);
  EXPECT_EQ(line.ask(bytes_of({3, 4, 7, 0, 1})), bytes_of({3, 2, 0, 0}));
}

TEST(ProgramMapWithoutProgram, Request_WhenNothingIsLoaded_ThenNoAddressExists) {
  TestBoard board;
  BoardLine line(board);
  for (const int function : {1, 2, 3, 4})
    EXPECT_EQ(line.ask(bytes_of({function, 0, 0, 0, 1})), bytes_of({function | 0x80, kIllegalAddress}));
}

}  // namespace
}  // namespace stepwright::test
