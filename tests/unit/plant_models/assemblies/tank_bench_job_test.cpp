// Long runs under a job that switches everything: conservation, and accuracy against the hand-written bench.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/bench/plant/bench_job.h"
#include "tests/bench/plant/bench_rk4.h"
#include "tests/unit/plant_models/assemblies/bench_rig.h"

namespace stepwright::assemblies {
namespace {

using namespace std::chrono_literals;

TEST(TankBenchJob, WhenOperatedForAnHour_ThenLiquidIsConserved) {
  BenchRig rig;
  bench::Job job;
  const double before = rig.truth("total_liquid");
  for (auto t = 0ms; t < 1h; t += 10ms) {
    bench::operate(job.next(rig.plant()), rig.plant());
    ASSERT_EQ(rig.plant().advance(10ms), core::PlantStatus::Good);
    // Spills, leaks and overflows count as well: a fault now and then.
    if (t.count() % 600'000 == 300'000) {
      ASSERT_TRUE(rig.plant().inject_fault("leak_a1", 0.2));
      ASSERT_TRUE(rig.plant().inject_fault("draw_c2", 5.0));
    }
    if (t.count() % 600'000 == 310'000) {
      ASSERT_TRUE(rig.plant().clear_fault("leak_a1"));
    }
    ASSERT_NEAR(rig.truth("total_liquid") / before, 1.0, 1e-9) << t.count() << " ms";
  }
  EXPECT_GT(job.rounds(), 50);
  EXPECT_GT(rig.truth("sump"), 0.1);
}

TEST(TankBenchJob, WhenComparedWithTheHandWrittenBench_ThenLevelsAndPositionAgree) {
  const BenchParameters parameters = BenchRig::exact();
  BenchRig rig(parameters);
  bench::HandBench hand(parameters);
  bench::Job job;
  double worst_percent = 0.0, worst_m = 0.0;
  for (auto t = 0ms; t < 120s; t += 10ms) {
    const bench::Outputs outputs = job.next(rig.plant());
    bench::operate(outputs, rig.plant());
    ASSERT_EQ(rig.plant().advance(10ms), core::PlantStatus::Good);
    std::copy_n(outputs.begin(), 4, hand.inputs.pump.begin());
    hand.inputs.drive = (outputs[5] ? 1 : 0) - (outputs[4] ? 1 : 0);
    for (int i = 0; i < 100; ++i) hand.step(1e-4);
    const char* levels[] = {"level_f1_percent", "level_v1_percent", "level_a1_percent", "level_a2_percent"};
    for (std::size_t i = 0; i < 4; ++i) {
      worst_percent = std::max(worst_percent, std::abs(rig.truth(levels[i]) - hand.percent(i)));
    }
    worst_m = std::max(worst_m, std::abs(rig.truth("position") - hand.state().x));
  }
  EXPECT_GE(job.rounds(), 2);
  EXPECT_LT(worst_percent, 0.02);
  EXPECT_LT(worst_m, 1e-4);
  RecordProperty("worst_percent", std::to_string(worst_percent));
}

TEST(TankBenchJob, WhenNothingIsSwitched_ThenTheSolverNeverRestarts) {
  BenchRig rig;
  rig.run(1.0);
  const auto before = rig.plant().statistics();
  rig.set("B3", true);
  rig.set("B3", false);
  rig.run(60.0);
  EXPECT_EQ(rig.plant().statistics().restarts, before.restarts);
}

// A vehicle that passes a place with its pumps at rest meets no discontinuity: start, standstill, no more.
TEST(TankBenchJob, WhenVehiclePassesAPlace_ThenOnlyTheSwitchingRestartsTheSolver) {
  BenchRig rig;
  rig.drive("drive_left", "fc2");
  const auto before = rig.plant().statistics();
  rig.drive("drive_right", "fc3");
  EXPECT_EQ(rig.plant().statistics().restarts, before.restarts + 3);  // drive on, drive off, standstill
}

}  // namespace
}  // namespace stepwright::assemblies
