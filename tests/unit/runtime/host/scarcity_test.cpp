// Every start of a thread and every large allocation on the way of a command is made to fail, one after the
// other: the command is refused, what runs goes on, and the next attempt is judged anew.

#include "tests/support/scarcity.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <functional>

#include "tests/unit/runtime/host/harness.h"
#include "tests/unit/runtime/host/st_program.h"

namespace stepwright::host {
namespace {

constexpr std::size_t kLarge = 64u << 10;
constexpr int kMostAttempts = 200;

// Three tasks, two of them on threads of their own; an image large enough for its memory to count as large.
std::vector<std::byte> three_tasks(const std::string& more = "") {
  return compiled(R"(
CONFIGURATION c
  VAR_GLOBAL out AT %QB0 : USINT; fast_count, slow_count, other_count : DINT;
    pad : ARRAY[0..99999] OF DINT; )" +
                  more + R"( END_VAR
  TASK fast(INTERVAL := T#2ms, PRIORITY := 0);
  TASK slow(INTERVAL := T#20ms, PRIORITY := 5);
  TASK other(INTERVAL := T#20ms, PRIORITY := 6);
  PROGRAM pf WITH fast : quick;
  PROGRAM ps WITH slow : heavy;
  PROGRAM po WITH other : third;
END_CONFIGURATION
PROGRAM quick
VAR_EXTERNAL fast_count : DINT; out : USINT; END_VAR
fast_count := fast_count + 1; out := 17;
END_PROGRAM
PROGRAM heavy
VAR_EXTERNAL slow_count : DINT; END_VAR
slow_count := slow_count + 1;
END_PROGRAM
PROGRAM third
VAR_EXTERNAL other_count : DINT; END_VAR
other_count := other_count + 1;
END_PROGRAM
)");
}

HostConfig scarce_config() {
  HostConfig config;
  config.clock = ClockMode::Real;
  config.safety.monitor_ns = 1'000'000;
  return config;
}

// A program runs; the command under test must leave it alone while it is refused.
struct Plant {
  Plant() : harness(scarce_config(), false) {
    EXPECT_EQ(harness.load(three_tasks(), "first"), Outcome::Done);
    EXPECT_EQ(harness.start(), Outcome::Done);
    EXPECT_TRUE(harness.wait([this] { return harness.driver.output.load() == 17; }));
  }
  // What runs goes on, commands are answered, and the monitor has looked at every thread it knows.
  void expect_untouched() {
    const std::uint64_t reads = harness.driver.reads.load();
    EXPECT_TRUE(harness.wait([&] { return harness.driver.reads.load() > reads + 10; }));
    EXPECT_EQ(harness.command(CommandKind::RecordEnd), Outcome::Done);
    EXPECT_EQ(harness.runtime->status().state, RuntimeState::Running);
    EXPECT_EQ(harness.runtime->status().program_digest, "first");
    EXPECT_EQ(harness.driver.output.load(), 17);
  }
  Harness harness;
};

support::FailingThread thread(int nth) {
  return support::FailingThread(nth);
}
support::FailingAllocation allocation(int nth) {
  return {nth, kLarge};
}

// Fails the first, second, ... until the command needs fewer. `attempt` returns the problems, if any.
template <typename Arm>
void fail_each(Plant& plant, Arm arm, const std::function<result::Diagnostics()>& attempt, const char* code,
               int at_least) {
  for (int nth = 1; nth <= kMostAttempts; ++nth) {
    bool happened = false;
    result::Diagnostics problems;
    {
      const auto failing = arm(nth);
      problems = attempt();
      happened = failing.happened();
    }
    if (!happened) {
      EXPECT_FALSE(result::has_errors(problems)) << result::to_string(problems);
      EXPECT_GT(nth, at_least) << "the way of this command has more of them";
      return;
    }
    ASSERT_TRUE(result::has_errors(problems)) << "number " << nth << " was not missed";
    EXPECT_EQ(problems.front().code, code) << "number " << nth << ": " << result::to_string(problems);
    plant.expect_untouched();
  }
  FAIL() << "it never succeeds";
}

result::Diagnostics load(Plant& plant, const std::string& digest) {
  auto accepted = plant.harness.try_load(three_tasks(), digest);
  return accepted.problems;
}

TEST(Scarcity, WhenAThreadCannotBeStarted_ThenTheDownloadIsRefusedAndWhatRunsGoesOn) {
  Plant plant;
  fail_each(
      plant, thread, [&] { return load(plant, "second"); }, "R0071", 2);
  EXPECT_EQ(plant.harness.runtime->status().program_digest, "second");
}

TEST(Scarcity, WhenAThreadCannotBeStarted_ThenAnOnlineChangeIsRefusedAndWhatRunsGoesOn) {
  Plant plant;
  fail_each(
      plant, thread, [&] { return plant.harness.change(three_tasks("extra : DINT;"), "second").problems; },
      "R0071", 2);
}

TEST(Scarcity, WhenNoThreadCanBeStarted_ThenARecordingIsRefusedAndWhatRunsGoesOn) {
  Plant plant;
  const std::string file = ::testing::TempDir() + "scarcity_" + std::to_string(::getpid());
  const auto attempt = [&]() -> result::Diagnostics {
    auto begun = plant.harness.runtime->record(0, {.file = file});
    if (!begun) return begun.error();
    EXPECT_TRUE(plant.harness.wait([&] { return plant.harness.runtime->take_completion().has_value(); }));
    return {};
  };
  fail_each(plant, thread, attempt, "R0071", 1);
  EXPECT_EQ(plant.harness.command(CommandKind::RecordEnd), Outcome::Done);
  for (const char* end : {"", ".1"}) std::remove((file + end).c_str());
}

TEST(Scarcity, WhenAThreadCannotBeStarted_ThenTheRuntimeDoesNotComeUpAndSaysSo) {
  FakeDriver driver;
  const HostConfig config = scarce_config();
  int nth = 1;
  for (; nth <= kMostAttempts; ++nth) {
    const support::FailingThread failing(nth);
    auto runtime = HostRuntime::create(config, driver, nullptr);
    if (!failing.happened()) {
      EXPECT_TRUE(runtime);
      break;
    }
    ASSERT_FALSE(runtime);
    EXPECT_EQ(runtime.error().front().code, "R0077");
  }
  EXPECT_GT(nth, 2);
}

TEST(Scarcity, WhenMemoryCannotBeHad_ThenTheDownloadIsRefusedAndWhatRunsGoesOn) {
  if (!support::can_fail_allocations()) GTEST_SKIP() << "a sanitizer owns operator new";
  Plant plant;
  load(plant, "first");  // the thread that prepares is there
  plant.harness.start();
  fail_each(
      plant, allocation, [&] { return load(plant, "second"); }, "R0072", 4);
}

TEST(Scarcity, WhenMemoryCannotBeHad_ThenAnOnlineChangeIsRefusedAndWhatRunsGoesOn) {
  if (!support::can_fail_allocations()) GTEST_SKIP() << "a sanitizer owns operator new";
  Plant plant;
  fail_each(
      plant, allocation,
      [&] { return plant.harness.change(three_tasks("extra : DINT;"), "second").problems; }, "R0072", 4);
}

TEST(Scarcity, WhenTheProgramTakesMoreThanTheLimitLeaves_ThenItIsRefusedWithTheFigure) {
  HostConfig config = scarce_config();
  config.memory_limit_bytes = 1u << 20;
  Harness harness(config, false);
  const Completion refused = harness.download(three_tasks());
  EXPECT_EQ(refused.outcome, Outcome::Refused);
  ASSERT_EQ(refused.problems.size(), 1u);
  EXPECT_EQ(refused.problems[0].code, "R0076");
  EXPECT_NE(refused.problems[0].message.find("MB"), std::string::npos);
  EXPECT_EQ(harness.runtime->status().state, RuntimeState::Empty);
}

}  // namespace
}  // namespace stepwright::host
