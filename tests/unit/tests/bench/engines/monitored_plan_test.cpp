// What monitors cost per scan, counted in code instead of time: a scan's cost follows from the code that it
// enters, which is the same on every machine.

#include "tests/bench/engines/monitored_plan.h"

#include <gtest/gtest.h>

namespace stepwright::bench {
namespace {

// Measured: 110 monitors, 20,005 bytes beside 7,295, 2.7 times as many. A section is jumped over while its
// action does not run, so time grows less: by a fifth (interpreter) to a half (machine code) in
// `scripts/bench engines`.
TEST(MonitoredPlan, WhenBothEnginesScanARun_ThenMonitorsCostTheSameBoundedCodeAndChangeNoOutput) {
  const MonitorFigures vm = measure_monitors(EngineKind::Vm, 0);
  const MonitorFigures native = measure_monitors(EngineKind::Native, 0);
  EXPECT_GT(vm.monitors, 100u);
  EXPECT_GT(vm.scans, 7'000u);
  EXPECT_GT(vm.with_bytes, vm.without_bytes);
  EXPECT_LT(vm.with_bytes, 3.0 * vm.without_bytes);
  EXPECT_EQ(vm.with_bytes, native.with_bytes);
  EXPECT_EQ(vm.without_bytes, native.without_bytes);
}

}  // namespace
}  // namespace stepwright::bench
