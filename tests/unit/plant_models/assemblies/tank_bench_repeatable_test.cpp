// Same seed and inputs, same bits; and nothing on the heap while the plant runs.

#include <gtest/gtest.h>

#include <vector>

#include "runtime/base/hash64.h"
#include "tests/bench/plant/bench_job.h"
#include "tests/support/malloc_guard.h"
#include "tests/unit/plant_models/assemblies/bench_rig.h"

namespace stepwright::assemblies {
namespace {

using namespace std::chrono_literals;

// Hash over every sensor reading of a job of 200 s; each scan of 10 ms is advanced in `slices` parts.
std::uint64_t sensor_trace(std::uint64_t seed, int slices) {
  BenchParameters parameters;
  parameters.seed = seed;
  BenchRig rig(parameters);
  bench::Job job;
  std::uint64_t hash = 0;
  for (auto t = 0ns; t < 200s; t += 10ms) {
    bench::operate(job.next(rig.plant()), rig.plant());
    for (int i = 1; i <= slices; ++i) rig.plant().advance_to(t + 10ms * i / slices);
    for (std::uint32_t s = 0; s < 6; ++s) {
      hash = base::hash_mix(hash, static_cast<std::uint64_t>(rig.plant().sensor(core::SensorId(s))));
    }
  }
  for (const double y : rig.plant().state()) hash = base::hash_mix(hash, std::bit_cast<std::uint64_t>(y));
  return hash;
}

TEST(TankBenchRepeatable, WhenSameSeedAndInputs_ThenSensorsAndStateAreBitIdentical) {
  EXPECT_EQ(sensor_trace(5, 1), sensor_trace(5, 1));
}

TEST(TankBenchRepeatable, WhenTimeIsSlicedFiner_ThenSensorsAndStateAreBitIdentical) {
  EXPECT_EQ(sensor_trace(5, 1), sensor_trace(5, 7));
}

TEST(TankBenchRepeatable, WhenSeedDiffers_ThenReadingsDiffer) {
  EXPECT_NE(sensor_trace(5, 1), sensor_trace(6, 1));
}

TEST(TankBenchRepeatable, WhenTimeHasPassedAlready_ThenNothingChanges) {
  BenchRig rig;
  rig.set("B1", true);
  rig.run(1.0);
  const double level = rig.truth("level_v1_percent");
  EXPECT_EQ(rig.plant().advance_to(500ms), core::PlantStatus::Good);
  EXPECT_EQ(rig.plant().now(), 1s);
  EXPECT_EQ(rig.truth("level_v1_percent"), level);
}

TEST(TankBenchRepeatable, WhenRunning_ThenNothingIsAllocated) {
  if (!support::guard_is_active()) GTEST_SKIP() << "a sanitizer owns the allocator";
  BenchRig rig;
  bench::Job job;
  const support::GuardCounts before = support::guard_counts();
  long sum = 0;
  for (int scan = 0; scan < 20'000; ++scan) {
    bench::operate(job.next(rig.plant()), rig.plant());
    rig.plant().advance(10ms);
    for (std::uint32_t s = 0; s < 6; ++s) sum += rig.plant().sensor(core::SensorId(s));
  }
  EXPECT_EQ(support::guard_counts(), before);
  EXPECT_GT(sum, 0);
  const auto after_proof = std::vector<int>(10);  // the counter does count
  EXPECT_GT(support::guard_counts().allocations, before.allocations);
}

}  // namespace
}  // namespace stepwright::assemblies
