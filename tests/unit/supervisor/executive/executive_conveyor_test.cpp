// The sorting line's job without the processes around it: seeds and faults. The judge is the plant: where its
// boxes ended, and whether a paddle ever met a running belt.

#include <gtest/gtest.h>

#include <ostream>

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
  EXPECT_LT(record.finished_s - record.started_s, record.episodes[0].planned_sequential_makespan_s);
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

}  // namespace
}  // namespace stepwright::executive
