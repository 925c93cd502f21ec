// Same parameters and calls, same bits; nothing on the heap while the plant runs; what the ports promise.

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "plant_models/core/counter_random.h"
#include "runtime/base/hash64.h"
#include "tests/support/malloc_guard.h"
#include "tests/unit/plant_models/assemblies/line_rig.h"

namespace stepwright::assemblies {
namespace {

using namespace std::chrono_literals;

// Switches every output now and then, as the seed of the switching says.
void operate(SortingLine& line, int scan, std::uint64_t switching) {
  const core::CounterRandom random(switching, 5);
  for (std::uint32_t i = 0; i < line.actuators().size(); ++i) {
    const std::uint64_t bits = random.bits(static_cast<std::uint64_t>(scan / 40) * 64 + i);
    line.set_actuator(core::ActuatorId(i), i + 1 == line.actuators().size() || bits % 3 != 0);
  }
}

// Hash over all sensors of two minutes and over the state at their end; every scan is advanced in `slices`
// parts.
std::uint64_t trace(const LineParameters& parameters, int slices) {
  auto line = SortingLine::create(parameters);
  std::uint64_t hash = 0;
  for (int scan = 0; scan < 12'000; ++scan) {
    operate(**line, scan, 3);
    for (int i = 1; i <= slices; ++i) (*line)->advance_to(10ms * scan + 10ms * i / slices);
    for (std::uint32_t s = 0; s < (*line)->sensors().size(); ++s) {
      hash = base::hash_mix(hash, static_cast<std::uint64_t>((*line)->sensor(core::SensorId(s))));
    }
  }
  return base::hash_mix(hash, (*line)->state_hash());
}

TEST(SortingLineRepeatable, WhenSameSeedAndInputs_ThenSensorsAndStateAreBitIdentical) {
  EXPECT_EQ(trace({.seed = 5}, 1), trace({.seed = 5}, 1));
}

TEST(SortingLineRepeatable, WhenTimeIsSlicedFiner_ThenSensorsAndStateAreBitIdentical) {
  EXPECT_EQ(trace({.seed = 5}, 1), trace({.seed = 5}, 7));
}

TEST(SortingLineRepeatable, WhenSeedDiffers_ThenTheTraceDiffers) {
  EXPECT_NE(trace({.seed = 5}, 1), trace({.seed = 6}, 1));
}

TEST(SortingLineRepeatable, WhenBoxesAreAllAlike_ThenTheSeedMakesNoDifference) {
  EXPECT_EQ(trace({.variety = false, .seed = 5}, 1), trace({.variety = false, .seed = 6}, 1));
}

TEST(SortingLineRepeatable, WhenTimeHasPassedAlready_ThenNothingChanges) {
  LineRig rig;
  rig.run(2.0);
  const std::uint64_t hash = rig.plant().state_hash();
  const auto now = rig.plant().now();
  EXPECT_EQ(rig.plant().advance_to(500ms), core::PlantStatus::Good);
  EXPECT_EQ(rig.plant().now(), now);
  EXPECT_EQ(rig.plant().state_hash(), hash);
}

// Box2D's memory of contacts is not among the numbers: boxes that touch may come to rest a hair beside.
TEST(SortingLineRepeatable, WhenAnotherProcessGoesOn_ThenBoxesCountsAndPaddlesAreWhereTheyWere) {
  LineRig rig({.seed = 4});
  ASSERT_TRUE(rig.feed() && rig.convey("in", "r") && rig.convey("r", "d1") && rig.divert(1) && rig.feed());
  rig.set("belt_in", true);
  rig.set("belt_r", true);
  rig.run(0.3);
  std::vector<double> numbers(rig.plant().kept_size());
  rig.plant().keep(numbers);
  LineRig other({.seed = 4});
  ASSERT_TRUE(other.plant().resume(numbers));
  for (const core::Quantity& truth : rig.plant().truths()) {
    EXPECT_NEAR(other.truth(truth.name), rig.truth(truth.name), 1e-6) << truth.name;
  }
  EXPECT_EQ(other.read("count_1"), 1);
  EXPECT_TRUE(other.run_until([&] { return other.read("count_1") == 1; }, 0.1));
  EXPECT_TRUE(other.convey("in", "r"));
  EXPECT_EQ(other.read("reader"), 2);
}

TEST(SortingLineRepeatable, WhenTheNumbersAreOfNoSuchLine_ThenNothingHappens) {
  LineRig rig;
  rig.run(1.0);
  const std::uint64_t hash = rig.plant().state_hash();
  std::vector<double> numbers(rig.plant().kept_size());
  EXPECT_FALSE(rig.plant().resume(std::span(numbers).first(3)));
  EXPECT_FALSE(rig.plant().resume(numbers));  // of a line without boxes
  rig.plant().keep(numbers);
  numbers[7] = std::nan("");
  EXPECT_FALSE(rig.plant().resume(numbers));
  EXPECT_EQ(rig.plant().state_hash(), hash);
}

// Memory that another process wrote, or half wrote, is not to be believed: each of these would make a box
// twice or let a number be cast that no count can be.
TEST(SortingLineRepeatable, WhenKeptNumbersContradictEachOther_ThenNothingHappens) {
  LineRig rig;
  ASSERT_TRUE(rig.feed());
  const std::uint64_t hash = rig.plant().state_hash();
  std::vector<double> good(rig.plant().kept_size());
  rig.plant().keep(good);
  constexpr std::size_t kNext = 1, kFirstBox = 5, kSecondBox = 15, kState = 1, kRank = 3, kX = 4;
  const std::pair<std::size_t, double> wrong[] = {
      {kNext, -1.0},                // no count
      {kNext, 0.0},                 // the box on the line would arrive again
      {kNext, 3.0},                 // the second box has arrived, and is announced
      {kFirstBox, 1.0},             // listed twice
      {kFirstBox, 0.5},             // no number of a box
      {kSecondBox, 1e300},          // nor this
      {kFirstBox + kState, 5.0},    // no state
      {kFirstBox + kRank, -2.0},    // no rank
      {kFirstBox + kX, 1e9},        // out of the world
      {good.size() - 2, 40'000.0},  // more than a counter shows
      {good.size() - 1, 1e12},      // more boxes than there are
  };
  for (const auto& [place, value] : wrong) {
    std::vector<double> numbers = good;
    numbers[place] = value;
    EXPECT_FALSE(rig.plant().resume(numbers)) << place << " = " << value;
    EXPECT_EQ(rig.plant().state_hash(), hash);
  }
  EXPECT_TRUE(rig.plant().resume(good));
}

TEST(SortingLineRepeatable, WhenAnotherProcessGoesOn_ThenCollisionsAreNotForgottenNorCountedAgain) {
  LineRig rig;
  rig.set("contactor", true);
  rig.set("belt_d1", true);
  rig.run(1.0);
  rig.set("push_1", true);
  rig.run(0.2);
  ASSERT_EQ(rig.truth("collisions"), 1.0);
  std::vector<double> numbers(rig.plant().kept_size());
  rig.plant().keep(numbers);
  LineRig other;
  ASSERT_TRUE(other.plant().resume(numbers));
  other.run(0.1);
  EXPECT_EQ(other.truth("collisions"), 1.0);
}

TEST(SortingLineRepeatable, WhenRunning_ThenNothingIsAllocated) {
  if (!support::guard_is_active()) GTEST_SKIP() << "a sanitizer owns the allocator";
  auto line = SortingLine::create({.boxes = 9, .arrival_s = 0.3, .seed = 2});
  const support::GuardCounts before = support::guard_counts();
  long sum = 0;
  for (int scan = 0; scan < 12'000; ++scan) {
    operate(**line, scan, 8);
    (*line)->advance(10ms);
    for (std::uint32_t s = 0; s < (*line)->sensors().size(); ++s) sum += (*line)->sensor(core::SensorId(s));
    for (std::uint32_t t = 0; t < (*line)->truths().size(); ++t)
      sum += static_cast<long>((*line)->truth(core::TruthId(t)));
  }
  EXPECT_EQ(support::guard_counts(), before);
  EXPECT_NE(sum, 0);
}

TEST(SortingLinePorts, WhenALineHasDiverters_ThenEveryNameIsUniqueAndEveryTruthOfTheDescriptionExists) {
  for (std::size_t diverters = 1; diverters <= 4; ++diverters) {
    auto line = SortingLine::create({.diverters = diverters, .boxes = 9});
    ASSERT_TRUE(line.has_value()) << result::to_string(line.error());
    std::set<std::string> names;
    for (const auto& port : (*line)->actuators()) EXPECT_TRUE(names.insert(port.name).second) << port.name;
    for (const auto& port : (*line)->sensors()) EXPECT_TRUE(names.insert(port.name).second) << port.name;
    for (const auto& belt : (*line)->description().belts) {
      if (belt.actuator.empty()) continue;
      EXPECT_TRUE(core::find_actuator(**line, belt.actuator)) << belt.actuator;
      EXPECT_TRUE(core::find_truth(**line, belt.speed_truth)) << belt.speed_truth;
    }
    for (const auto& beam : (*line)->description().beams) EXPECT_TRUE(core::find_sensor(**line, beam.name));
    for (const auto& pusher : (*line)->description().pushers) {
      EXPECT_TRUE(core::find_actuator(**line, pusher.actuator)) << pusher.actuator;
      EXPECT_TRUE(core::find_truth(**line, pusher.travel_truth)) << pusher.travel_truth;
    }
    for (const auto& box : (*line)->description().boxes) EXPECT_TRUE(core::find_truth(**line, box.x_truth));
    EXPECT_EQ((*line)->layout().chutes.size(), diverters + 1);
  }
}

TEST(SortingLineParameters, WhenFiguresHaveNoSense_ThenEachIsReported) {
  LineParameters wrong;
  wrong.diverters = 0;
  wrong.boxes = 12;
  wrong.drive.current_limit_a = 0.5;
  const auto line = SortingLine::create(wrong);
  ASSERT_FALSE(line.has_value());
  EXPECT_EQ(line.error().size(), 3u);
  for (const auto& problem : line.error()) EXPECT_EQ(problem.code, "C0321");
}

}  // namespace
}  // namespace stepwright::assemblies
