#include "supervisor/ltl/mission/train_planning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "supervisor/ltl/mission/train_reading.h"
#include "tests/unit/supervisor/ltl/program/small_hall.h"

namespace stepwright::ltl {
namespace {

TrainPlanningOptions options_for(const std::string& task) {
  return {.problem = testing::small_hall(2, task),
          .terminals = train_terminals_in_a_row(2, 3),
          .program = {},
          .most_s = 600.0};
}

std::size_t drives(const PreparedTrain& prepared) {
  return static_cast<std::size_t>(
      std::ranges::count(prepared.program.steps, TrainStepKind::Drive, &TrainStep::kind));
}

class TrainPlanningTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto opened = TrainPlanning::open(options_for("visit press then visit rack"));
    ASSERT_TRUE(opened) << to_string(opened.error());
    planning_ = *std::move(opened);
  }
  TrainRequest request() const {
    return {.task = &planning_->first_task(),
            .state = planning_->first_task().begins(),
            .standing = planning_->options().problem.standing(),
            .trailers = 2};
  }

  std::optional<TrainPlanning> planning_;
};

TEST_F(TrainPlanningTest, WhenATaskIsPlanned_ThenTheProgramGoesThroughItsStates) {
  const auto prepared = planning_->plan(request());
  ASSERT_TRUE(prepared) << to_string(prepared.error());
  EXPECT_EQ(drives(*prepared), 2u);
  EXPECT_FALSE(prepared->container.empty());
  EXPECT_TRUE(TrainReader::create(prepared->container, prepared->program, 2));
  EXPECT_EQ(prepared->train.width_m, planning_->options().problem.train.width_m) << "without the margin";
}

TEST_F(TrainPlanningTest, WhenHalfOfItIsDone_ThenTheRestIsPlanned) {
  TrainRequest half = request();
  half.state = half.task->monitor.next(half.state, 1);
  const auto prepared = planning_->plan(half);
  ASSERT_TRUE(prepared) << to_string(prepared.error());
  EXPECT_EQ(drives(*prepared), 1u);
  EXPECT_TRUE(planning_->halt(*prepared, half.state));
}

TEST_F(TrainPlanningTest, WhenATrailerIsLeft_ThenThePlanIsForTheOthers) {
  TrainRequest fewer = request();
  fewer.trailers = 1;
  const auto prepared = planning_->plan(fewer);
  ASSERT_TRUE(prepared) << to_string(prepared.error());
  EXPECT_EQ(prepared->train.trailers, 1u);
}

TEST_F(TrainPlanningTest, WhenAPlaceIsOutOfService_ThenThereIsNoPlan) {
  TrainRequest blocked = request();
  blocked.blocked = {planning_->options().problem.floor.propositions[1]};
  const auto prepared = planning_->plan(blocked);
  ASSERT_FALSE(prepared);
  EXPECT_EQ(prepared.error().front().code, kImpossible);
}

TEST(TrainPlanning, WhenATaskIsWrong_ThenItIsRefusedWithItsPlace) {
  const auto code = [](const std::string& task) {
    const auto opened = TrainPlanning::open(options_for(task));
    return opened ? std::string() : opened.error().front().code;
  };
  EXPECT_EQ(code("visit pres"), "L0311");
  EXPECT_EQ(code("X press"), "L0503");
  EXPECT_EQ(code("G press"), "L0011");
  EXPECT_EQ(code("visit ("), "L0002");
}

TEST(TrainReading, WhenHitchesAreBent_ThenTrailersHeadElsewhere) {
  TrainReading reading;
  reading.pose = {1.0, 2.0, 0.5};
  reading.hitches_rad = {0.2, -0.1, 0.4};
  reading.trailers = 2;
  const TrainState state = reading.standing_state();
  EXPECT_EQ(state[kTrainHeading], 0.5);
  EXPECT_DOUBLE_EQ(state[kTrainTrailer], 0.3);
  EXPECT_DOUBLE_EQ(state[kTrainTrailer + 1], 0.4);
  EXPECT_EQ(state[kTrainTrailer + 2], 0.0);
}

}  // namespace
}  // namespace stepwright::ltl
