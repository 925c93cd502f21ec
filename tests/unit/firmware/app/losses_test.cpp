#include "tests/unit/firmware/app/board_test.h"

namespace stepwright::test {
namespace {

class LossesTest : public BoardTest {
 protected:
  Bytes outputs(std::size_t count) {
    Bytes bytes(count);
    EXPECT_TRUE(controller.link().outputs(bytes));
    return bytes;
  }
};

TEST_F(LossesTest, Scans_WhenByTheClock_ThenRunEveryInterval) {
  load_and_start(kCounting, 0);
  for (int i = 0; i < 10; ++i) {
    board.run_ms(100);
    controller.turn(bytes_of({5}));
  }
  const auto status = controller.status();
  EXPECT_EQ(status.state, State::Running);
  EXPECT_NEAR(static_cast<double>(status.scan), 100, 2);
  EXPECT_EQ(outputs(1)[0], std::byte{5});
  EXPECT_EQ(status.overruns, 0u);
}

TEST_F(LossesTest, Scans_WhenTheLoopWasAwayLong_ThenOverrunsAreCounted) {
  load_and_start(kCounting, 0);
  board.run_ms(20);
  board.tick.now += 95'000'000;
  board.run_ms(5);
  EXPECT_EQ(controller.status().overruns, 8u) << "of nine cycles the newest runs";
  EXPECT_EQ(controller.status().state, State::Running);
}

TEST_F(LossesTest, Silence_WhenLongerThanHalfASecond_ThenOutputsAreSafeAndAStartLeavesIt) {
  load_and_start(kCounting, 0);
  controller.turn(bytes_of({255}));
  board.run_ms(490);
  EXPECT_EQ(controller.status().state, State::Running);
  EXPECT_EQ(outputs(1)[0], std::byte{255});
  board.run_ms(40);
  auto status = controller.status();
  EXPECT_EQ(status.state, State::Fault);
  EXPECT_EQ(status.flags & control::kInputsLost, control::kInputsLost);
  EXPECT_EQ(status.event_kind, control::Event::Trap);
  EXPECT_FALSE(status.trap) << "no program is to blame";
  EXPECT_EQ(outputs(4), Bytes(4));
  controller.turn(bytes_of({255}));
  EXPECT_EQ(controller.status().state, State::Fault) << "the plant that answers again starts nothing";
  controller.start(0);
  status = controller.status();
  EXPECT_EQ(status.state, State::Running);
  EXPECT_EQ(status.flags & control::kInputsLost, 0);
}

TEST_F(LossesTest, Silence_WhenProgramHasNoPlant_ThenIsNoLoss) {
  load_and_start("PROGRAM main VAR n : DINT; END_VAR n := n + 1; END_PROGRAM", 0);
  board.run_ms(3'000);
  EXPECT_EQ(controller.status().state, State::Running);
  EXPECT_GT(controller.status().scan, 290u);
}

TEST_F(LossesTest, Trap_WhenAProgramDividesByZero_ThenIsLocatedAndOutputsAreSafe) {
  load_and_start(kDividing, control::kStartLockStep);
  EXPECT_EQ(controller.turn(bytes_of({5})).outputs[0], std::byte{1});
  const auto trapped = controller.turn(bytes_of({0}));
  EXPECT_EQ(trapped.outputs[0], std::byte{0});
  EXPECT_EQ(trapped.head.state, State::Fault);
  const auto status = controller.status();
  EXPECT_EQ(status.trap.code, bytecode::TrapCode::DivisionByZero);
  EXPECT_GT(status.trap.pc, 0u);
  controller.start_lock_step();
  EXPECT_FALSE(controller.status().trap) << "a start leaves the fault";
  EXPECT_EQ(controller.turn(bytes_of({5})).head.state, State::Running);
}

TEST_F(LossesTest, Trap_WhenAProgramNeverEnds_ThenTheBudgetEndsIt) {
  load_and_start(kEndless, control::kStartLockStep);
  EXPECT_EQ(controller.turn({}).head.state, State::Fault);
  EXPECT_EQ(controller.status().trap.code, bytecode::TrapCode::Watchdog);
  EXPECT_EQ(outputs(1)[0], std::byte{0});
}

TEST_F(LossesTest, Stop_WhenCommanded_ThenOutputsAreSafeAtOnce) {
  load_and_start(kCounting, control::kStartLockStep);
  controller.turn(bytes_of({255}));
  EXPECT_EQ(outputs(1)[0], std::byte{255});
  controller.expect_done(Command::Stop);
  EXPECT_EQ(outputs(4), Bytes(4));
  EXPECT_EQ(controller.status().event_kind, control::Event::Stopped);
}

TEST_F(LossesTest, Outputs_WhenWrittenWhileNothingRuns_ThenStaySafe) {
  load_and_start(kCounting, control::kStartLockStep);
  controller.expect_done(Command::Stop);
  EXPECT_EQ(exception_of(bytes_of({5, 0, 0, 0xFF, 0})), 0);
  EXPECT_EQ(bits(Command::WriteBits, 1, 0xFF, 0xFF).refusal, Refusal::Done);
  EXPECT_EQ(outputs(4), Bytes(4));
}

TEST_F(LossesTest, Watchdog_WhenTheLoopTurns_ThenIsFed) {
  EXPECT_TRUE(board.watchdog.started);
  const int before = board.watchdog.fed;
  board.run_ms(5);
  EXPECT_EQ(board.watchdog.fed, before + 5);
}

TEST_F(LossesTest, Status_WhenTheWatchdogHasReset_ThenSaysSo) {
  board.watchdog.caused = true;
  board.watchdog.count = 3;
  board.reset();
  const auto status = controller.status();
  EXPECT_EQ(status.flags & control::kWatchdogReset, control::kWatchdogReset);
  EXPECT_EQ(status.resets, 3);
}

TEST_F(LossesTest, Loop_WhenThereIsNothingToDo_ThenRests) {
  board.run_ms(3);
  EXPECT_GE(board.tick.rests, 3);
}

}  // namespace
}  // namespace stepwright::test
