// The sorting line's job without the processes around it: seeds and faults. The judge is the plant: where its
// boxes ended, and whether a paddle ever met a running belt.

#include <gtest/gtest.h>

#include <initializer_list>
#include <ostream>
#include <string>
#include <vector>

#include "plant_models/core/counter_random.h"
#include "supervisor/pddl/describe_run.h"
#include "tests/unit/supervisor/executive/bench_fixture.h"
#include "tests/unit/supervisor/executive/conveyor_fixture.h"

namespace stepwright::executive {
namespace {

using support::PlantFault;
using support::SimulatedController;

class ExecutiveConveyorSeeds : public testing::TestWithParam<std::uint64_t> {};

TEST_P(ExecutiveConveyorSeeds, WhenNothingGoesWrong_ThenEveryBoxIsWhereItWasOrderedInItsOrder) {
  SimulatedController controller = conveyor_controller(GetParam());
  const RunRecord record = run_conveyor(controller);
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_TRUE(record.replans.empty());
  EXPECT_EQ(sorted_boxes(controller), ordered_boxes());
  EXPECT_EQ(controller.plant_value("collisions"), 0);
  EXPECT_LT(controller.plant_value("greatest_force"), 550.0);
  ASSERT_EQ(record.episodes.size(), 1u);
  EXPECT_TRUE(record.episodes[0].proved_optimal);
  // Six to seven boxes a minute, two of which went round; half the time of the same plan one action after the
  // other.
  EXPECT_LT(record.finished_s - record.started_s, 45.0);
  EXPECT_LT(record.finished_s - record.started_s, 0.6 * record.episodes[0].planned_sequential_makespan_s);
  EXPECT_FALSE(controller.any_output());
}

INSTANTIATE_TEST_SUITE_P(Seeds, ExecutiveConveyorSeeds, testing::Range(std::uint64_t{1}, std::uint64_t{31}));

TEST(ExecutiveConveyor, WhenTheSameSeedRunsTwice_ThenTheTracesAreEqual) {
  std::uint64_t hashes[2] = {};
  for (std::uint64_t& hash : hashes) {
    SimulatedController controller = conveyor_controller(4);
    EXPECT_EQ(run_conveyor(controller).phase, Phase::Done);
    hash = controller.status()->trace_hash;
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(ExecutiveConveyor, WhenSensorsCountPieces_ThenNoMonitorWantsThemToMoveAllTheWhile) {
  DeskOptions options = config::desk_options(conveyor_cell());
  options.monitors = true;
  const auto desk = PlanningDesk::open(options);
  ASSERT_TRUE(desk);
  const auto initial = pddl::to_named(desk->task().initial());
  const auto outcome = desk->prepare({.start = {.planning = initial}});
  ASSERT_TRUE(outcome);
  EXPECT_FALSE(outcome->prepared.translation.monitors.empty());
  for (const translate::Monitor& monitor : outcome->prepared.translation.monitors)
    EXPECT_NE(monitor.kind, translate::MonitorKind::Motion) << monitor.text;
}

// Faults that somebody puts right: the safety program stops the line, the executive waits for the reset,
// plans anew and reaches the goal.
struct MendedCase {
  const char* name;
  std::vector<PlantFault> faults;
  const char* cause;  // within that of the first replan
};

[[maybe_unused]] void PrintTo(const MendedCase& c, std::ostream* out) {
  *out << c.name;
}

class ExecutiveConveyorMended : public testing::TestWithParam<MendedCase> {};

TEST_P(ExecutiveConveyorMended, WhenItIsPutRight_ThenTheGoalIsReached) {
  SimulatedController controller = conveyor_controller(2, GetParam().faults);
  const RunRecord record = run_conveyor(controller);
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, Phase::Done);
  ASSERT_FALSE(record.replans.empty());
  EXPECT_NE(record.replans[0].cause.find(GetParam().cause), std::string::npos);
  EXPECT_EQ(sorted_boxes(controller), ordered_boxes());
  EXPECT_EQ(controller.plant_value("collisions"), 0);
}

INSTANTIATE_TEST_SUITE_P(
    Faults, ExecutiveConveyorMended,
    testing::Values(
        MendedCase{
            "Jam",
            {{3.0, "jam_d1", 1}, {25.0, "jam_d1", 0}, {26.0, "press_reset", 1}, {26.5, "press_reset", 0}},
            "'contactor closed' was lost"},
        MendedCase{"EmergencyStop",
                   {{6.2, "press_estop", 1},
                    {14.0, "press_estop", 0},
                    {20.0, "press_reset", 1},
                    {20.5, "press_reset", 0}},
                   "'contactor closed' was lost"},
        MendedCase{"StuckDiverter", {{15.0, "stuck_push_1", 1}, {29.0, "stuck_push_1", 0}}, "(divert b3"},
        MendedCase{"SlippingBelt",
                   {{0.0, "slip_in", 0}, {20.0, "slip_in", 1}},
                   "(feed b1 b2 in) did not end within 15 s"}),
    [](const auto& each) { return std::string(each.param.name); });

// Faults that stay: whatever happens, the run ends at the goal or safely, and says why.
struct LastingCase {
  const char* name;
  std::vector<PlantFault> faults;
  const char* says;  // within the message or the cause of a replan
};

[[maybe_unused]] void PrintTo(const LastingCase& c, std::ostream* out) {
  *out << c.name;
}

class ExecutiveConveyorLasting : public testing::TestWithParam<LastingCase> {};

TEST_P(ExecutiveConveyorLasting, WhenItStays_ThenTheRunEndsSafelyAndSaysWhy) {
  SimulatedController controller = conveyor_controller(3, GetParam().faults);
  const RunRecord record = run_conveyor(controller);
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, Phase::Safe);
  EXPECT_NE(story(record).find(GetParam().says), std::string::npos);
  EXPECT_FALSE(controller.any_output());
  EXPECT_EQ(controller.plant_value("collisions"), 0);
}

INSTANTIATE_TEST_SUITE_P(
    Faults, ExecutiveConveyorLasting,
    testing::Values(LastingCase{"Jam", {{3.0, "jam_d1", 1}}, "(await_reset) did not end within 60 s"},
                    LastingCase{"JamWithReset",
                                {{3.0, "jam_d1", 1}, {25.0, "press_reset", 1}, {25.5, "press_reset", 0}},
                                "'contactor closed' was lost"},
                    LastingCase{"EmergencyStop", {{9.0, "press_estop", 1}}, "'contactor closed'"},
                    LastingCase{"StuckDiverter", {{15.0, "stuck_push_1", 1}}, "(divert b3"},
                    LastingCase{"EyeStuckOff", {{3.0, "stuck_eye_d1", 0}}, "did not end within"},
                    LastingCase{"EyeStuckOn",
                                {{3.0, "stuck_eye_d2", 1}},
                                "'box at the diverter 2' is observed, but not expected"},
                    LastingCase{"BoxTakenAway", {{8.0, "lose_box", 1}}, "b1"},
                    LastingCase{"BoxesExchanged",
                                {{0.0, "exchange_boxes", 2}},
                                "number of the box at the reader is 3.0, expected 2.0"},
                    LastingCase{"DeadBelt", {{4.0, "slip_r", 0}, {4.0, "slip_in", 0}}, "did not end within"}),
    [](const auto& each) { return std::string(each.param.name); });

// A random fault at a random time; most are put right after a while.
std::vector<PlantFault> random_faults(std::uint64_t seed) {
  const core::CounterRandom random(seed, 900);
  std::uint64_t draw = 0;
  const auto pick = [&](std::uint64_t count) { return random.bits(draw++) % count; };
  const auto name = [&](const std::string& kind, std::initializer_list<const char*> parts) {
    return kind + *(parts.begin() + pick(parts.size()));
  };
  const double from_s = 0.5 + 0.1 * static_cast<double>(pick(400));
  const double until_s = from_s + 3.0 + static_cast<double>(pick(20));
  const auto mended = [&](const std::string& fault, double wrong, double right) {
    return std::vector<PlantFault>{{from_s, fault, wrong},
                                   {until_s, fault, right},
                                   {until_s + 1.0, "press_reset", 1},
                                   {until_s + 1.5, "press_reset", 0}};
  };
  switch (pick(7)) {
    case 0:
      return mended(name("jam_", {"in", "r", "d1", "d2", "e", "t"}), 1, 0);
    case 1:
      return mended(name("stuck_push_", {"1", "2", "e", "t"}), 1, 0);
    case 2:
      return mended(name("slip_", {"in", "r", "d1", "d2", "e", "t"}), 0.1 * static_cast<double>(pick(3)), 1);
    case 3:
      return mended("press_estop", 1, 0);
    case 4:
      return {{from_s, name("stuck_eye_", {"in", "r", "d1", "d2", "e", "t", "t1"}),
               static_cast<double>(pick(2))}};
    case 5:
      return {{from_s, "lose_box", static_cast<double>(1 + pick(5))}};
    default:
      return {{from_s, "exchange_boxes", static_cast<double>(1 + pick(4))}};
  }
}

class ExecutiveConveyorCampaign : public testing::TestWithParam<std::uint64_t> {};

TEST_P(ExecutiveConveyorCampaign,
       WhenAFaultIsRandom_ThenTheOrderIsMetAsThePlantSaysOrTheLineIsSafeWithAReason) {
  const std::vector<PlantFault> faults = random_faults(GetParam());
  SimulatedController controller = conveyor_controller(GetParam(), faults);
  const RunRecord record = run_conveyor(controller);
  SCOPED_TRACE(faults[0].name + " at " + std::to_string(faults[0].at_s) + " s: " + story(record));
  EXPECT_EQ(controller.plant_value("collisions"), 0);
  EXPECT_FALSE(controller.any_output());
  if (record.phase == Phase::Done) {
    EXPECT_EQ(sorted_boxes(controller), ordered_boxes());
  } else {
    EXPECT_EQ(record.phase, Phase::Safe);
    EXPECT_FALSE(record.message.empty());
    EXPECT_FALSE(record.replans.empty());
    // What somebody has put right is no reason to give up, unless a box was moved meanwhile.
    EXPECT_NE(faults[0].name, "press_estop");
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ExecutiveConveyorCampaign,
                         testing::Range(std::uint64_t{1}, std::uint64_t{61}));

}  // namespace
}  // namespace stepwright::executive
