#include <random>

#include "tests/unit/firmware/app/board_test.h"

namespace stepwright::test {
namespace {

class SerialLineTest : public BoardTest {
 protected:
  void noise(std::initializer_list<int> values) {
    for (const int value : values) board.uart.incoming.push_back(static_cast<std::byte>(value));
  }
  bool answers() { return !line.ask(bytes_of({3, 0xF0, 0, 0, 2})).empty(); }
};

TEST_F(SerialLineTest, Request_WhenForAnotherUnit_ThenIsNotAnswered) {
  EXPECT_TRUE(line.ask(bytes_of({3, 0xF0, 0, 0, 2}), 2).empty());
  EXPECT_TRUE(answers());
}

TEST_F(SerialLineTest, Broadcast_WhenItWrites_ThenIsCarriedOutAndNotAnswered) {
  load_and_start(kCounting, control::kStartLockStep);
  EXPECT_TRUE(line.ask(bytes_of({6, 4, 0, 0, 42}), 0).empty());
  EXPECT_EQ(line.ask(bytes_of({3, 4, 0, 0, 1})), bytes_of({3, 2, 0, 42}));
}

TEST_F(SerialLineTest, Request_WhenHalfOfOneCameBefore_ThenIsAnsweredAfterASilence) {
  noise({1, 16, 0xF2, 0, 0, 10, 20, 1, 2});
  board.run_ms(60);
  EXPECT_TRUE(answers());
}

TEST_F(SerialLineTest, Request_WhenItsSumIsWrong_ThenIsNotAnswered) {
  noise({1, 3, 0xF0, 0, 0, 2, 0, 0});
  board.run_ms(60);
  EXPECT_TRUE(board.uart.outgoing.empty());
  EXPECT_TRUE(answers());
}

TEST_F(SerialLineTest, Line_WhenNoiseComes_ThenARequestIsAnsweredAfterEachBurst) {
  load_and_start(kCounting, control::kStartLockStep);
  const auto hash = controller.status().trace_hash;
  std::mt19937 random(5);
  for (int burst = 0; burst < 300; ++burst) {
    for (auto i = random() % 300; i > 0; --i) board.uart.incoming.push_back(static_cast<std::byte>(random()));
    board.run_ms(60);
    ASSERT_TRUE(answers()) << burst;
  }
  EXPECT_EQ(controller.status().trace_hash, hash) << "noise has let a scan run";
}

}  // namespace
}  // namespace stepwright::test
