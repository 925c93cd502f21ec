#include "cell/campaign/disturbance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "plant_models/assemblies/tank_bench.h"
#include "plant_models/components/library/catalogue.h"
#include "plant_models/components/model_plant.h"

namespace stepwright::campaign {
namespace {

std::vector<OfferedFault> bench_offers() {
  return offered_faults(*assemblies::TankBench::create({}).value());
}

TEST(Disturbance, WhenTheSeedIsTheSame_ThenTheSameFaults) {
  const auto offered = bench_offers();
  std::set<std::string> stories;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const std::string words = draw(seed, offered, 100.0).words();
    EXPECT_EQ(words, draw(seed, offered, 100.0).words());
    stories.insert(words);
  }
  EXPECT_GT(stories.size(), 40u);
}

TEST(Disturbance, WhenManyAreDrawn_ThenAllKindsWithinTheirRanges) {
  const auto offered = bench_offers();
  std::map<std::string, core::FaultRange> ranges;
  for (const OfferedFault& fault : offered) ranges[fault.name] = fault.range;
  std::map<std::string, int> kinds;
  std::set<std::string> names;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const Disturbance drawn = draw(seed, offered, 100.0);
    ++kinds[drawn.kind()];
    for (const DrawnFault& fault : drawn.faults) {
      names.insert(fault.name);
      const core::FaultRange& range = ranges.at(fault.name);
      EXPECT_GE(fault.value, range.min);
      EXPECT_LE(fault.value, range.max);
      EXPECT_TRUE(!range.whole || fault.value == std::floor(fault.value));
      EXPECT_LE(fault.at_s, 90.0);
      EXPECT_TRUE(!fault.ends_s || *fault.ends_s > fault.at_s);
    }
  }
  EXPECT_GT(kinds["none"], 20);
  EXPECT_GT(kinds["single"], 100);
  EXPECT_GT(kinds["compound"], 80);
  EXPECT_EQ(names.size(), offered.size());
}

void expect_all_taken(core::Plant& plant) {
  const auto offered = offered_faults(plant);
  EXPECT_EQ(offered.size(), plant.faults().size());
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    for (const simulation::PlantFault& fault : draw(seed, offered, 100.0).schedule()) {
      const auto taken =
          fault.clears ? plant.clear_fault(fault.name) : plant.inject_fault(fault.name, fault.value);
      EXPECT_TRUE(taken) << fault.name << " " << fault.value;
    }
  }
}

TEST(Disturbance, WhenDrawn_ThenTheBenchTakesEveryOne) {
  expect_all_taken(*assemblies::TankBench::create({}).value());
}

TEST(Disturbance, WhenDrawn_ThenAPlantOfComponentsTakesEveryOne) {
  expect_all_taken(*components::ModelPlant::load(STEPWRIGHT_SOURCE_DIR "/tests/cells/bench_model/plant.toml",
                                                 components::library::catalogue(), {})
                        .value());
}

TEST(Disturbance, WhenNothingIsOffered_ThenUndisturbed) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) EXPECT_TRUE(draw(seed, {}, 100.0).faults.empty());
}

TEST(Disturbance, WhenAFaultEnds_ThenItIsCleared) {
  const Disturbance what{{{"leak", "l/s", 0.5, 3.0, 7.0}}};
  const auto schedule = what.schedule();
  ASSERT_EQ(schedule.size(), 2u);
  EXPECT_FALSE(schedule[0].clears);
  EXPECT_TRUE(schedule[1].clears);
  EXPECT_EQ(schedule[1].at_s, 7.0);
  EXPECT_EQ(what.words(), "leak = 0.5 l/s from 3.0 s for 4.0 s");
}

TEST(Patterns, WhenAStarStands_ThenAnyTextFits) {
  EXPECT_TRUE(fits("t1.*", "T1.leak"));
  EXPECT_TRUE(fits("*.stuck", "p1.stuck"));
  EXPECT_TRUE(fits("*a*a*", "banana"));
  EXPECT_TRUE(fits("*", ""));
  EXPECT_FALSE(fits("*.stuck", "p1.stuck_open"));
  EXPECT_FALSE(fits("leak", "leak_a1"));
}

TEST(Patterns, WhenOneFitsNothing_ThenRefusedWithWhatIsThere) {
  const auto offered = bench_offers();
  EXPECT_EQ(chosen(offered, {"leak_*"}).value().size(), 4u);
  const auto none = chosen(offered, {"leak_*", "flood"});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().front().code, "C0311");
  EXPECT_NE(none.error().front().hint.find("leak_a1"), std::string::npos);
}

}  // namespace
}  // namespace stepwright::campaign
