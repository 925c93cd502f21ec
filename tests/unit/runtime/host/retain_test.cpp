// Warm and cold starts of a whole runtime, and that keeping values costs its scans nothing that they must not
// do.

#include <gtest/gtest.h>

#include <filesystem>

#include "ladder/driver/compile.h"
#include "runtime/bytecode/reader/program_info.h"
#include "tests/support/malloc_guard.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/runtime/host/harness.h"

namespace stepwright::host {
namespace {

// Counts scans in retained `total` and in `here`; divides by zero in scan 30 of a run.
std::vector<std::byte> counting_program(const std::string& more = "") {
  const std::string text = "PROGRAM MAIN\nVAR RETAIN total : DINT; END_VAR VAR here, x : DINT; END_VAR\n" +
                           more +
                           "total := total + 1; here := here + 1; x := 1 / (30 - here);\nEND_PROGRAM\n";
  return std::move(driver::compile({{{"counting.st", text}}})->container);
}

double value(const std::vector<std::byte>& container, const char* path, const StepEvent& event) {
  return reader::read_number(*reader::ProgramInfo::read(container)->find(path), event.image);
}

// Runs until the trap of its 30th scan.
StepEvent run(Harness& harness, bool cold = false) {
  Command command;
  command.kind = CommandKind::Start;
  command.cold = cold;
  EXPECT_EQ(harness.command(command).outcome, Outcome::Done);
  EXPECT_EQ(harness.event().kind, EventKind::Started);
  StepEvent end = harness.event();
  EXPECT_EQ(end.kind, EventKind::Trap);
  return end;
}

TEST(RetainedRuntime, WhenStartedAgain_ThenRetainedValuesGoOnAndOthersBeginAnew) {
  const std::vector<std::byte> container = counting_program();
  Harness harness;
  harness.load(container);
  run(harness);
  const StepEvent warm = run(harness);
  EXPECT_EQ(value(container, "MAIN.total", warm), 60);
  EXPECT_EQ(value(container, "MAIN.here", warm), 30);
  const StepEvent cold = run(harness, true);
  EXPECT_EQ(value(container, "MAIN.total", cold), 30);
}

TEST(RetainedRuntime, WhenTheEventOfAStartComes_ThenItsImageHasTheRetainedValues) {
  const std::vector<std::byte> container = counting_program();
  Harness harness;
  harness.load(container);
  run(harness);
  harness.start();
  EXPECT_EQ(value(container, "MAIN.total", harness.event()), 30);
}

TEST(RetainedRuntime, WhenAnotherProgramIsLoaded_ThenItTakesTheValuesOver) {
  const std::vector<std::byte> second = counting_program("VAR RETAIN fresh : INT := 4; END_VAR\n");
  Harness harness;
  harness.load(counting_program());
  run(harness);
  harness.load(second);
  const StepEvent end = run(harness);
  EXPECT_EQ(value(second, "MAIN.total", end), 60);
  EXPECT_EQ(value(second, "MAIN.fresh", end), 4);
  EXPECT_NE(harness.runtime->status().detail.find("1 new (MAIN.fresh)"), std::string::npos);
}

TEST(RetainedRuntime, WhenThePolicyIsRefuse_ThenTheCompletionSaysWhatDoesNotFit) {
  HostConfig config;
  config.retain.policy = record::RetainPolicy::Refuse;
  Harness harness(config);
  harness.load(counting_program());
  run(harness);
  harness.load(counting_program("VAR RETAIN fresh : INT; END_VAR\n"));
  Command start;
  start.kind = CommandKind::Start;
  const Completion refused = harness.command(start);
  EXPECT_EQ(refused.outcome, Outcome::RetainRefused);
  ASSERT_EQ(refused.problems.size(), 1u);
  EXPECT_EQ(refused.problems[0].code, "R0025");
  EXPECT_EQ(harness.runtime->status().state, RuntimeState::Stopped);
}

// Every scan hands its values over here; in operation one in a hundred does.
TEST(RetainedRuntime, WhenEveryScanIsKept_ThenScansNeitherAllocateNorLock) {
  if (!support::guard_is_active()) GTEST_SKIP() << "a sanitizer owns malloc";
  const support::TemporaryFolder folder;
  HostConfig config;
  config.retain.store = folder / "retain.store";
  config.retain.period_ns = 1;
  {
    Harness harness(config);
    support::GuardCounts before;
    std::uint64_t scans = 0;
    std::uint64_t noisy = 0;
    harness.driver.on_read = [&](std::int64_t) {
      const support::GuardCounts now = support::guard_counts();
      // The first scan comes after commands, which may allocate.
      if (++scans > 1 && !(now == before)) ++noisy;
      before = now;
    };
    harness.load(counting_program());
    run(harness);
    harness.runtime.reset();  // joins the scan thread
    EXPECT_GE(scans, 30u);
    EXPECT_EQ(noisy, 0u);
  }
  EXPECT_TRUE(record::RetainStore::read(config.retain.store).value());
}

}  // namespace
}  // namespace stepwright::host
