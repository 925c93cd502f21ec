#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdio>
#include <string>
#include <vector>

#include "tests/support/malloc_guard.h"
#include "tests/unit/runtime/host/harness.h"

namespace stepwright::host {
namespace {

// Counts on the scan thread from one read of the inputs to the next: the whole path of a scan, events
// included.
void expect_quiet_scans(const HostConfig& config, std::uint32_t interval_us,
                        const std::string& recording = {}) {
  if (!support::guard_is_active()) GTEST_SKIP() << "a sanitizer owns malloc";
  Harness harness(config);
  if (!recording.empty()) harness.record({.file = recording, .keyframe_every = 5});
  support::GuardCounts before;
  std::uint64_t scans = 0;
  std::uint64_t noisy = 0;
  harness.driver.on_read = [&](std::int64_t) {
    const support::GuardCounts now = support::guard_counts();
    // The first scan comes after commands, which may allocate.
    if (++scans > 1 && !(now == before)) ++noisy;
    before = now;
  };
  harness.load(support::step_program({.steps = 20, .scans_per_step = 3, .interval_us = interval_us}));
  harness.start();
  for (int i = 0; i < 21; ++i) harness.event();
  harness.runtime.reset();  // joins the scan thread
  EXPECT_GT(scans, 50u);
  EXPECT_EQ(noisy, 0u);
}

TEST(ScanPath, WhenSimulated_ThenScansNeitherAllocateNorLock) {
  for (const EngineKind engine : {EngineKind::Auto, EngineKind::Vm}) {
    HostConfig config;
    config.engine = engine;
    expect_quiet_scans(config, 10'000);
  }
}

TEST(ScanPath, WhenReal_ThenScansNeitherAllocateNorLock) {
  HostConfig config;
  config.clock = ClockMode::Real;
  expect_quiet_scans(config, 500);
}

TEST(ScanPath, WhenItIsRecorded_ThenScansNeitherAllocateNorLock) {
  const std::string file = ::testing::TempDir() + "scan_path_" + std::to_string(::getpid());
  for (const ClockMode clock : {ClockMode::Simulated, ClockMode::Real}) {
    HostConfig config;
    config.clock = clock;
    expect_quiet_scans(config, 500, file);
  }
  for (const char* end : {"", ".1"}) std::remove((file + end).c_str());
}

// Ends in the safe state, whose scans are counted as well.
TEST(ScanPath, WhenWatchdogsAndRampsAreOn_ThenScansNeitherAllocateNorLock) {
  for (const EngineKind engine : {EngineKind::Auto, EngineKind::Vm}) {
    HostConfig config;
    config.clock = ClockMode::Real;
    config.engine = engine;
    config.idle_interval_ns = 500'000;
    config.safety.watchdog = {.time_ns = 1'000'000'000, .sensitivity = 2};
    config.safety.monitor_ns = 1'000'000;
    for (auto& column : config.safety.safe_state.columns)
      column.ramps = {{.byte = 0, .type = scan::RampType::U8, .target = 200, .per_second = 100}};
    expect_quiet_scans(config, 500);
  }
}

}  // namespace
}  // namespace stepwright::host
