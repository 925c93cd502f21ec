// The figures that a binding needs: how far a pump runs on after its switch-off, how long things take.
// Prints them, and holds them to the ranges that plant_models/doc/bench.md states.

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/unit/plant_models/assemblies/bench_rig.h"

namespace stepwright::assemblies {
namespace {

struct PumpFigures {
  double seconds_per_level = 0.0;  // while running, averaged over the run
  double run_out_percent = 0.0;    // delivered after switch-off
};

// Runs `output` from switch-on until `truth` has changed by `levels`, then lets it run down.
PumpFigures measure(BenchRig& rig, const char* output, const char* truth, double levels) {
  const double start = rig.truth(truth);
  const auto moved = [&] { return std::abs(rig.truth(truth) - start); };
  rig.set(output, true);
  const double seconds = rig.run_until([&] { return moved() >= 10.0 * levels; });
  const double at_switch_off = moved();
  rig.set(output, false);
  rig.run(3.0);
  return {seconds / levels, moved() - at_switch_off};
}

void print(const char* what, const PumpFigures& f) {
  std::printf("[ figures  ] %-28s %.2f s per level, run-out %.2f percent\n", what, f.seconds_per_level,
              f.run_out_percent);
}

void expect_within(const PumpFigures& f, double least_s, double most_s) {
  EXPECT_GT(f.seconds_per_level, least_s);
  EXPECT_LT(f.seconds_per_level, most_s);
  EXPECT_GT(f.run_out_percent, 0.1);
  EXPECT_LT(f.run_out_percent, 0.9);
}

TEST(TankBenchCalibration, WhenPumpsAreMeasured_ThenTimesAndRunOutAreAsDocumented) {
  BenchRig rig;
  const auto load_low = measure(rig, "B1", "level_v1_percent", 1.0);
  const auto load = measure(rig, "B1", "level_v1_percent", 6.5);
  rig.drive("drive_left", "fc2");
  const auto unload_full = measure(rig, "B2", "level_a1_percent", 1.0);
  const auto unload = measure(rig, "B2", "level_a1_percent", 6.0);
  const auto draw_full = measure(rig, "B3", "level_a1_percent", 1.0);
  const auto draw = measure(rig, "B3", "level_a1_percent", 6.0);
  print("B1 load, 2 -> 3", load_low);
  print("B1 load, 3 -> 9.5", load);
  print("B2 unload, 10 -> 9", unload_full);
  print("B2 unload, 9 -> 3", unload);
  print("B3 draw, 9 -> 8", draw_full);
  print("B3 draw, 8 -> 2", draw);
  for (const PumpFigures& f : {load, unload}) expect_within(f, 1.0, 1.5);
  for (const PumpFigures& f : {load_low, unload_full}) expect_within(f, 1.0, 1.7);
  for (const PumpFigures& f : {draw, draw_full}) expect_within(f, 2.0, 3.0);
}

TEST(TankBenchCalibration, WhenTripsAreMeasured_ThenTimesAreAsDocumented) {
  for (const double percent : {20.0, 100.0}) {
    BenchParameters parameters = BenchRig::exact();
    parameters.tanks[1].initial_percent = percent;
    BenchRig rig(parameters);
    const double there = rig.drive("drive_left", "fc2");
    const double stop = rig.truth("position");
    const double back = rig.drive("drive_right", "fc1");
    const double on = rig.drive("drive_right", "fc3");
    const double across = rig.drive("drive_left", "fc2");
    std::printf(
        "[ figures  ] vehicle at %3.0f percent: f1-a1 %.2f s (stops at %.4f m), a1-f1 %.2f s, "
        "f1-a2 %.2f s, a2-a1 %.2f s\n",
        percent, there, stop, back, on, across);
    for (const double seconds : {there, back, on}) {
      EXPECT_GT(seconds, 4.0);
      EXPECT_LT(seconds, 6.0);
    }
    EXPECT_GT(across, 8.0);
    EXPECT_LT(across, 10.0);
  }
}

}  // namespace
}  // namespace stepwright::assemblies
