// A runtime on the real clock: when it scans, and what it says of scans that are late.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "runtime/host/host_runtime.h"
#include "tests/unit/runtime/host/harness.h"

namespace stepwright::host {
namespace {

using support::step_program;

TEST(HostRuntime, WhenTheClockIsReal_ThenScansFollowItAndInputsStayFreshWhenStopped) {
  HostConfig config;
  config.clock = ClockMode::Real;
  config.idle_interval_ns = 1'000'000;
  Harness harness(config);
  harness.load(step_program({.interval_us = 1'000}));
  const auto begin = std::chrono::steady_clock::now();
  harness.start(true);  // a barrier never holds in real time
  EXPECT_EQ(harness.event().kind, EventKind::Started);
  harness.event();
  harness.event();
  const StepEvent last = harness.event();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  EXPECT_EQ(last.kind, EventKind::StepChange);
  EXPECT_GE(wall.count(), 0.019);
  EXPECT_GE(last.time_ns, 20'000'000);
  harness.stop();
  const std::uint64_t reads = harness.driver.reads;
  EXPECT_TRUE(harness.wait([&] { return harness.driver.reads > reads + 3; }));
  EXPECT_EQ(harness.driver.output, 0x00);
}

// Accepted, it would be taken back by the first scan.
TEST(HostRuntime, WhenTheInputOutputIsStillLost_ThenAStartInRealTimeIsRefusedUntilItIsBack) {
  HostConfig config;
  config.clock = ClockMode::Real;
  config.idle_interval_ns = 1'000'000;
  Harness harness(config);
  harness.load(step_program({.interval_us = 1'000}));
  ASSERT_EQ(harness.start(), Outcome::Done);
  EXPECT_EQ(harness.event().kind, EventKind::Started);
  harness.driver.lost = true;
  StepEvent event = harness.event();
  while (event.kind == EventKind::StepChange) event = harness.event();
  EXPECT_EQ(event.detail, "the I/O driver does not answer");
  const std::uint64_t last = event.sequence;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(harness.start(), Outcome::IoLost);
  EXPECT_EQ(harness.runtime->status().state, RuntimeState::Fault);
  EXPECT_EQ(harness.runtime->status().last_event, last) << "what was refused is no event";
  harness.driver.lost = false;
  EXPECT_EQ(harness.start(), Outcome::Done);
  EXPECT_EQ(harness.runtime->status().state, RuntimeState::Running);
}

// On a machine that is busy other scans are late, too: every instant of the grid has its scan or its overrun.
TEST(HostRuntime, WhenARealScanIsLate_ThenOverrunsAreCountedAndTheRestIsOnTime) {
  constexpr std::int64_t kIntervalNs = 2'000'000;
  HostConfig config;
  config.clock = ClockMode::Real;
  std::atomic<int> reads{0};
  Harness harness(config);
  harness.load(step_program({.interval_us = 2'000}));
  harness.start();
  ASSERT_TRUE(harness.wait([&] { return harness.runtime->status().scan > 0; }));
  const RuntimeStatus before = harness.runtime->status();
  harness.driver.intervene([&](std::int64_t) {
    if (++reads == 3) std::this_thread::sleep_for(std::chrono::milliseconds(12));
  });
  ASSERT_TRUE(harness.wait([&] {
    return reads > 10 && harness.runtime->status().overruns >= before.overruns + 5;
  })) << "five scans were due while the inputs were read";
  const RuntimeStatus after = harness.runtime->status();
  const std::int64_t passed_ns = after.time_ns - before.time_ns;
  EXPECT_EQ(passed_ns % kIntervalNs, 0) << "the grid is the same";
  EXPECT_EQ(static_cast<std::uint64_t>(passed_ns / kIntervalNs),
            after.scan - before.scan + after.overruns - before.overruns);
  harness.stop();
}

}  // namespace
}  // namespace stepwright::host
