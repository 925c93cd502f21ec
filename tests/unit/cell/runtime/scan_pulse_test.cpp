#include "cell/runtime/scan_pulse.h"

#include <gtest/gtest.h>

namespace stepwright::cell_runtime {
namespace {

using namespace std::chrono_literals;
const ScanPulse::Clock::time_point kStart = ScanPulse::Clock::time_point{} + 1h;

host::RuntimeStatus running(std::uint64_t scan) {
  host::RuntimeStatus status;
  status.state = host::RuntimeState::Running;
  status.scan = scan;
  return status;
}

TEST(ScanPulse, WhenScansProgress_ThenItIsAlive) {
  ScanPulse pulse(500ms);
  for (int i = 0; i < 100; ++i) {
    pulse.see(running(static_cast<std::uint64_t>(i)), kStart + i * 100ms);
    EXPECT_TRUE(pulse.alive(kStart + i * 100ms));
  }
}

TEST(ScanPulse, WhenTheScanHangs_ThenItIsDeadAfterThePatience) {
  ScanPulse pulse(500ms);
  for (int i = 0; i < 10; ++i) pulse.see(running(7), kStart + i * 100ms);
  EXPECT_TRUE(pulse.alive(kStart + 500ms));
  EXPECT_FALSE(pulse.alive(kStart + 501ms));
  pulse.see(running(8), kStart + 2s);
  EXPECT_TRUE(pulse.alive(kStart + 2s));
}

TEST(ScanPulse, WhenTheTaskIsSlow_ThenItIsGivenItsTime) {
  ScanPulse pulse(500ms);
  pulse.set_period(1s);
  for (int i = 0; i < 40; ++i) pulse.see(running(7), kStart + i * 100ms);
  EXPECT_TRUE(pulse.alive(kStart + 4s));
  EXPECT_FALSE(pulse.alive(kStart + 4s + 1ms));
}

TEST(ScanPulse, WhenNothingIsDue_ThenItIsAliveForEver) {
  ScanPulse pulse(500ms);
  host::RuntimeStatus stopped;
  stopped.state = host::RuntimeState::Stopped;
  pulse.see(stopped, kStart);
  EXPECT_TRUE(pulse.alive(kStart + 1h));
  host::RuntimeStatus waiting = running(3);
  waiting.waiting_for_supervisor = true;
  pulse.see(waiting, kStart + 1h);
  EXPECT_TRUE(pulse.alive(kStart + 2h));
  // And when the barrier falls, the time at it does not count.
  pulse.see(running(3), kStart + 2h);
  EXPECT_TRUE(pulse.alive(kStart + 2h + 100ms));
}

}  // namespace
}  // namespace stepwright::cell_runtime
