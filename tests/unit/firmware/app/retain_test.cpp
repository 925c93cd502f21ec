#include <cstring>

#include "runtime/bytecode/reader/program_info.h"
#include "tests/unit/firmware/app/board_test.h"

namespace stepwright::test {
namespace {

class RetainTest : public BoardTest {
 protected:
  std::int32_t kept() {
    const auto info = reader::ProgramInfo::read(compiled(kCounting)).value();
    const Bytes image = controller.image();
    std::int32_t value = 0;
    std::memcpy(&value, image.data() + info.find("main.kept")->address, sizeof(value));
    return value;
  }
  void scans(int count) {
    for (int i = 0; i < count; ++i) controller.turn(bytes_of({0}));
  }
  bool restored() { return (controller.status().flags & control::kRetainRestored) != 0; }
};

TEST_F(RetainTest, Values_WhenStoppedAndReset_ThenAreThereAtTheNextStart) {
  load_and_start(kCounting, control::kStartLockStep);
  EXPECT_FALSE(restored());
  scans(12);
  controller.expect_done(Command::Stop);
  board.run_ms(20);
  board.reset();
  controller.start(control::kStartLockStep);
  EXPECT_EQ(kept(), 12);
  EXPECT_TRUE(restored());
}

TEST_F(RetainTest, Values_WhenStartIsCold_ThenAreInitial) {
  load_and_start(kCounting, control::kStartLockStep);
  scans(3);
  controller.expect_done(Command::Stop);
  controller.start(control::kStartLockStep | control::kStartCold);
  EXPECT_EQ(kept(), 0);
  EXPECT_FALSE(restored());
}

TEST_F(RetainTest, Values_WhenItRunsByTheClockAndIsReset_ThenAreAtMostAPeriodOld) {
  load_and_start(kCounting, 0);
  for (int i = 0; i < 34; ++i) {
    board.run_ms(100);
    controller.turn(bytes_of({0}));
  }
  EXPECT_GT(kept(), 330);
  board.reset();  // the watchdog's, as far as the flash can tell
  controller.start(0);
  EXPECT_GE(kept(), 300);
  EXPECT_TRUE(restored());
}

TEST_F(RetainTest, Values_WhenTheyDoNotChange_ThenAreNotWrittenAgain) {
  load_and_start("PROGRAM main VAR RETAIN x : DINT := 5; END_VAR END_PROGRAM", 0);
  board.run_ms(1'500);
  const std::size_t written = board.flash.programmed;
  board.run_ms(10'000);
  EXPECT_EQ(board.flash.programmed, written);
}

TEST_F(RetainTest, Values_WhenAnotherProgramComes_ThenDoNotReachIt_AndWaitForTheirOwn) {
  load_and_start(kCounting, control::kStartLockStep);
  scans(5);
  controller.download(compiled(kDividing));
  controller.start(control::kStartLockStep);
  EXPECT_FALSE(restored());
  controller.download(compiled(kCounting));
  controller.start(control::kStartLockStep);
  EXPECT_EQ(kept(), 5);
}

TEST_F(RetainTest, Values_WhenCleared_ThenAreInitial_ButNotWhileItRuns) {
  load_and_start(kCounting, control::kStartLockStep);
  scans(5);
  EXPECT_EQ(controller.command(Command::ClearRetained).refusal, Refusal::NotStopped);
  controller.expect_done(Command::Stop);
  controller.expect_done(Command::ClearRetained);
  controller.start(control::kStartLockStep);
  EXPECT_EQ(kept(), 0);
}

TEST_F(RetainTest, Values_WhenTheProgramTraps_ThenAreKept) {
  load_and_start(R"(
    PROGRAM main
    VAR divisor AT %IB0 : USINT; x : INT; END_VAR
    VAR RETAIN kept : DINT; END_VAR
      kept := kept + 1;
      x := 10 / divisor;
    END_PROGRAM)",
                 control::kStartLockStep);
  controller.turn(bytes_of({1}));
  controller.turn(bytes_of({0}));
  EXPECT_EQ(controller.status().state, State::Fault);
  board.run_ms(20);
  board.reset();
  controller.start(control::kStartLockStep);
  EXPECT_TRUE(restored());
}

}  // namespace
}  // namespace stepwright::test
