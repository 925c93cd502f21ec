#include <random>

#include "runtime/modbus/pdu/serve.h"
#include "tests/support/lock_step/host_machine.h"
#include "tests/support/malloc_guard.h"
#include "tests/support/step_program.h"
#include "tests/unit/firmware/app/board_test.h"

namespace stepwright::test {
namespace {

class LockStepTest : public BoardTest {
 protected:
  // The firmware and both engines of the host, scan by scan with the same random inputs.
  void expect_equal_traces(const Bytes& container, int scans) {
    controller.download(container);
    controller.start_lock_step();
    support::HostMachine vm(container, host::EngineKind::Vm, app::kBudget);
    std::mt19937 random(1);
    Bytes inputs(controller.status().input_bytes);
    for (int i = 0; i < scans; ++i) {
      for (std::byte& byte : inputs) byte = static_cast<std::byte>(random());
      const auto host = vm.scan(inputs);
      const auto here = controller.turn(inputs);
      ASSERT_EQ(here.head.scan, host.scan);
      ASSERT_EQ(here.head.time_ns, host.time_ns);
      ASSERT_EQ(here.head.trace_hash, vm.cycle().trace_hash()) << "scan " << i + 1;
      ASSERT_TRUE(std::ranges::equal(here.outputs, vm.image().outputs())) << "scan " << i + 1;
      if (host.trap) return;
    }
    EXPECT_TRUE(std::ranges::equal(controller.image(), vm.image().bytes()));
  }
};

TEST_F(LockStepTest, Trace_WhenInputsAreTheSame_ThenIsThatOfTheHost) {
  expect_equal_traces(compiled(kCounting), 50);
}

TEST_F(LockStepTest, Trace_WhenAProgramTraps_ThenIsThatOfTheHostUpToTheTrap) {
  expect_equal_traces(compiled(kDividing), 2000);
  EXPECT_EQ(controller.status().state, State::Fault);
}

TEST_F(LockStepTest, Turn_WhenRepeated_ThenLetsNoScanRun) {
  load_and_start(kCounting, control::kStartLockStep);
  Bytes outputs(4);
  const auto first = controller.link().exchange(7, bytes_of({1}), outputs);
  const auto again = controller.link().exchange(7, bytes_of({2}), outputs);
  ASSERT_TRUE(first && again);
  EXPECT_EQ(again->scan, first->scan);
  EXPECT_EQ(again->trace_hash, first->trace_hash);
  EXPECT_EQ(outputs[0], std::byte{1}) << "the inputs of the repetition are not taken";
  EXPECT_EQ(controller.link().exchange(8, bytes_of({2}), outputs)->scan, first->scan + 1);
}

TEST_F(LockStepTest, Clock_WhenInLockStep_ThenLetsNoScanRun) {
  load_and_start(kCounting, control::kStartLockStep);
  board.run_ms(2'000);
  EXPECT_EQ(controller.status().scan, 0u);
  EXPECT_EQ(controller.status().state, State::Running) << "a master may take its time";
}

TEST_F(LockStepTest, Turn_WhenNothingRuns_ThenInputsAreSeenAndOutputsSafe) {
  load_and_start(kCounting, control::kStartLockStep);
  controller.turn(bytes_of({9}));
  controller.expect_done(Command::Stop);
  const auto after = controller.turn(bytes_of({77}));
  EXPECT_EQ(after.head.scan, 1u);
  EXPECT_EQ(after.outputs, Bytes(4));
  EXPECT_EQ(controller.image()[0], std::byte{77});
}

TEST_F(LockStepTest, Events_WhenStepsChange_ThenEachIsCountedWithItsImage) {
  support::StepProgramOptions options{.steps = 3, .scans_per_step = 4};
  controller.download(support::step_program(options));
  controller.start_lock_step();
  EXPECT_EQ(controller.status().event_kind, control::Event::Started);
  const auto started = controller.status().event;
  for (int i = 0; i < 4; ++i) controller.turn(Bytes(8));
  EXPECT_EQ(controller.turn(Bytes(8)).head.event, started + 2) << "the first step, then the second";
  const auto status = controller.status();
  EXPECT_EQ(status.event_kind, control::Event::StepChange);
  EXPECT_EQ(status.event_scan, 5u);
  const Bytes at_event = controller.image();
  controller.turn(Bytes(8));
  EXPECT_EQ(controller.memory(control::Memory::EventImage, at_event.size()), at_event);
  EXPECT_NE(controller.image(), at_event);
}

TEST_F(LockStepTest, Scan_WhenServedOverTheLine_ThenTakesNoHeapAndNoLock) {
  if (!support::guard_is_active()) GTEST_SKIP() << "a sanitizer has malloc";
  load_and_start(kCounting, control::kStartLockStep);
  app::Slave slave(board.controller());
  const Bytes request = bytes_of({23, 0xF2, 0x80, 0, 24, 0xF2, 0, 0, 2, 4, 0, 9, 1, 0});
  std::array<std::byte, modbus::pdu::kMaxPdu> answer;
  const auto before = support::guard_counts();
  const std::size_t length = modbus::pdu::serve(slave, request, answer);
  EXPECT_EQ(support::guard_counts(), before);
  EXPECT_EQ(length, 2u + 48u);
  EXPECT_EQ(board.machine().figures().scan, 1u);
}

}  // namespace
}  // namespace stepwright::test
