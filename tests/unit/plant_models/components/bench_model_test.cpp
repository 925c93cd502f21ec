// The tank bench as a file of components beside the built-in one.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "plant_models/assemblies/tank_bench.h"
#include "plant_models/components/library/catalogue.h"
#include "plant_models/components/model_plant.h"
#include "tests/bench/plant/bench_job.h"

namespace stepwright::components {
namespace {

using namespace std::chrono_literals;

const std::string kBench = std::string(STEPWRIGHT_SOURCE_DIR) + "/tests/cells/bench_model/plant.toml";

std::unique_ptr<ModelPlant> make_model(const ModelOptions& options = {}) {
  auto plant = ModelPlant::load(kBench, library::catalogue(), options);
  if (!plant) throw std::runtime_error(result::to_string(plant.error()));
  return std::move(*plant);
}

double truth(const core::Plant& plant, std::string_view name) {
  return plant.truth(core::find_truth(plant, name).value());
}

assemblies::BenchParameters seeded(std::uint64_t seed) {
  assemblies::BenchParameters parameters;
  parameters.seed = seed;
  return parameters;
}

// Both do the same, which the built-in one decides.
class Pair {
 public:
  explicit Pair(std::uint64_t seed)
      : built_in(assemblies::TankBench::create(seeded(seed)).value()), model(make_model({.seed = seed})) {}
  void scan() {
    const bench::Outputs outputs = job.next(*built_in);
    bench::operate(outputs, *built_in);
    bench::operate(outputs, *model);
    ASSERT_EQ(built_in->advance(10ms), core::PlantStatus::Good);
    ASSERT_EQ(model->advance(10ms), core::PlantStatus::Good);
  }
  std::unique_ptr<assemblies::TankBench> built_in;
  std::unique_ptr<ModelPlant> model;
  bench::Job job;
};

TEST(BenchModel, WhenItDoesTheJobForTenMinutes_ThenLevelsAndReadingsAreThoseOfTheBuiltInOne) {
  Pair pair(7);
  const char* const levels[] = {"level_f1_percent", "level_v1_percent", "level_a1_percent",
                                "level_a2_percent"};
  const char* const shown[] = {"fc1", "fc2", "fc3", "S1", "S2", "S3"};
  double worst = 0.0;
  int readings = 0;
  for (auto t = 0ms; t < 600s; t += 10ms) {
    ASSERT_NO_FATAL_FAILURE(pair.scan());
    for (const char* level : levels)
      worst = std::max(worst, std::abs(truth(*pair.built_in, level) - truth(*pair.model, level)));
    worst = std::max(worst, std::abs(truth(*pair.built_in, "position") - truth(*pair.model, "position")));
    for (const char* name : shown) {
      const int one = pair.built_in->sensor(core::find_sensor(*pair.built_in, name).value());
      const int other = pair.model->sensor(core::find_sensor(*pair.model, name).value());
      ASSERT_LE(std::abs(one - other), 1)
          << name << " at " << t.count() << " ms";  // a last bit that is rounded otherwise
      readings += one == other ? 1 : 0;
    }
  }
  EXPECT_GT(pair.job.rounds(), 8);
  EXPECT_LT(worst, 1e-4);  // percent: a millionth of a tank
  EXPECT_GT(readings, 6 * 59'900);
  std::printf("largest difference of a level %.2e percent\n", worst);
}

TEST(BenchModel, WhenFaultsHold_ThenTheyDoAsThoseOfTheBuiltInOne) {
  Pair pair(3);
  const std::pair<const char*, double> faults[] = {{"leak_a1", 0.2},   {"weak_b1", 0.5},  {"draw_c2", 5.0},
                                                   {"frozen_s2", 1.0}, {"drift_s3", 2.0}, {"stuck_fc2", 1.0}};
  for (auto t = 0ms; t < 60s; t += 10ms) {
    if (t == 5s) {
      for (const auto& [name, value] : faults) {
        ASSERT_TRUE(pair.built_in->inject_fault(name, value)) << name;
        ASSERT_TRUE(pair.model->inject_fault(name, value)) << name;
      }
    }
    ASSERT_NO_FATAL_FAILURE(pair.scan());
  }
  for (const char* name : {"level_f1_percent", "level_v1_percent", "level_a1_percent", "level_a2_percent",
                           "sump", "delivered_c2_percent"})
    EXPECT_NEAR(truth(*pair.built_in, name), truth(*pair.model, name), 1e-4) << name;
  for (const char* name : {"fc2", "S2", "S3"})
    EXPECT_NEAR(pair.built_in->sensor(core::find_sensor(*pair.built_in, name).value()),
                pair.model->sensor(core::find_sensor(*pair.model, name).value()), 1)
        << name;
  EXPECT_GT(truth(*pair.model, "sump"), 0.1);
}

TEST(BenchModel, WhenItRunsForAnHour_ThenLiquidIsConserved) {
  Pair pair(1);
  const double before = truth(*pair.model, "plant.liquid");
  for (auto t = 0ms; t < 1h; t += 10ms) {
    if (t == 10min) {
      ASSERT_TRUE(pair.model->inject_fault("a1.leak", 0.5));
    }
    if (t == 11min) {
      ASSERT_TRUE(pair.model->clear_fault("a1.leak"));
    }
    ASSERT_NO_FATAL_FAILURE(pair.scan());
  }
  EXPECT_GT(truth(*pair.model, "sump"), 0.1);
  EXPECT_NEAR(truth(*pair.model, "plant.liquid") / before, 1.0, 1e-9);
}

TEST(BenchModel, WhenTimeIsSlicedFiner_ThenStateAndReadingsAreTheSameBits) {
  const auto coarse = make_model();
  const auto fine = make_model();
  for (int scan = 0; scan < 2'000; ++scan) {
    for (ModelPlant* plant : {coarse.get(), fine.get()}) {
      plant->set_actuator(core::find_actuator(*plant, "B1").value(), scan % 300 < 150 ? 1 : 0);
      plant->set_actuator(core::find_actuator(*plant, "drive_left").value(), scan % 700 > 400 ? 1 : 0);
      plant->set_actuator(core::find_actuator(*plant, "B2").value(), scan % 500 > 450 ? 1 : 0);
    }
    ASSERT_EQ(coarse->advance(10ms), core::PlantStatus::Good);
    for (int i = 0; i < 5; ++i) {
      ASSERT_EQ(fine->advance(2ms), core::PlantStatus::Good);
      (void)truth(*fine, "b1.flow");
    }
    ASSERT_TRUE(std::ranges::equal(coarse->state(), fine->state())) << scan;
    for (std::uint32_t i = 0; i < coarse->sensors().size(); ++i)
      ASSERT_EQ(coarse->sensor(core::SensorId(i)), fine->sensor(core::SensorId(i)));
  }
}

TEST(BenchModel, WhenItsStateIsKept_ThenAnotherProcessGoesOnFromThere) {
  const auto first = make_model();
  first->set_actuator(core::find_actuator(*first, "B1").value(), 1);
  ASSERT_EQ(first->advance(3s), core::PlantStatus::Good);
  std::vector<double> kept(first->kept_size());
  first->keep(kept);
  auto second = ModelPlant::load(kBench, library::catalogue(), {}, kept);
  ASSERT_TRUE(second);
  EXPECT_EQ(truth(**second, "v1.level"), truth(*first, "v1.level"));
  kept.back() += 1.0;  // of another plant
  auto third = ModelPlant::load(kBench, library::catalogue(), {}, kept);
  ASSERT_TRUE(third);
  EXPECT_NEAR(truth(**third, "v1.level"), 20.0, 1e-9);
}

}  // namespace
}  // namespace stepwright::components
