#include "cell/missions/ltl/train_of_plant.h"

#include <gtest/gtest.h>

#include "supervisor/ltl/scene/problem_reader.h"

namespace stepwright::missions {
namespace {

config::PlantConfig tugger() {
  config::PlantConfig plant;
  plant.kind = "tugger";
  return plant;
}

TEST(TrainOfPlant, WhenThePlantHasItsDefaults_ThenTheyArePlannedWithAsWithoutAPlant) {
  config::PlantConfig none;
  none.kind = "none";
  const ltl::TrainModel with = train_of(tugger()), without = train_of(none);
  EXPECT_EQ(with.wheelbase_m, without.wheelbase_m);
  EXPECT_EQ(with.hitch_m, without.hitch_m);
  EXPECT_EQ(with.length_m, without.length_m);
  EXPECT_EQ(with.width_m, without.width_m);
  EXPECT_EQ(with.spacing_m, without.spacing_m);
  EXPECT_EQ(with.most_speed_m_s, without.most_speed_m_s);
  EXPECT_EQ(with.most_acceleration_m_s2, without.most_acceleration_m_s2);
  EXPECT_EQ(with.most_lock_rad, without.most_lock_rad);
  EXPECT_EQ(with.most_lock_rate_rad_s, without.most_lock_rate_rad_s);
  const ltl::TrainDrive drive = drive_of(tugger(), 1.2), plain = drive_of(none, 1.2);
  EXPECT_EQ(drive.top_speed_m_s, plain.top_speed_m_s);
  EXPECT_EQ(drive.speed_up_m_s2, plain.speed_up_m_s2);
  EXPECT_EQ(drive.brake_m_s2, plain.brake_m_s2);
  EXPECT_EQ(drive.hard_brake_m_s2, plain.hard_brake_m_s2);
  EXPECT_EQ(drive.lock_rate_rad_s, plain.lock_rate_rad_s);
  EXPECT_EQ(drive.speed_lag_s, plain.speed_lag_s);
  EXPECT_EQ(drive.lock_lag_s, plain.lock_lag_s);
}

TEST(TrainOfPlant, WhenTheProblemNamesNoFigure_ThenItIsThePlants) {
  config::PlantConfig plant = tugger();
  plant.tugger.train.hitch_m = 1.3;
  plant.tugger.steering.full_lock_rad = 0.7;
  const std::string text =
      R"({"scene": "hall.geojson", "train": {"trailers": 2, "width_m": 0.6}, "start": {"x_m": 8, "y_m": 3,
 "heading_rad": 0}, "task": "visit press"})";
  const auto problem = ltl::read_planning_problem(
      text, STEPWRIGHT_SOURCE_DIR "/tests/cells/tugger/problem.json", train_of(plant));
  ASSERT_TRUE(problem) << result::to_string(problem.error());
  EXPECT_EQ(problem->train.trailers, 2u);
  EXPECT_EQ(problem->train.width_m, 0.6);
  EXPECT_EQ(problem->train.hitch_m, 1.3);
  EXPECT_EQ(problem->train.most_lock_rad, 0.7);
}

TEST(TrainOfPlant, WhenTheProblemsTrainIsAnotherOne_ThenThatIsToldAtThePlantsKeys) {
  config::PlantConfig plant = tugger();
  plant.tugger.trailers = plant.tugger.most_trailers = 3;
  plant.tugger.most_where = {"cell.toml", 21, 12};
  plant.tugger.train.hitch_m = 1.4;
  plant.tugger.train.where["hitch_m"] = {"cell.toml", 30, 11};
  ltl::TrainModel train = train_of(plant);
  train.trailers = 3;
  EXPECT_TRUE(check_agrees(plant, train));
  train.trailers = 2;
  EXPECT_TRUE(check_agrees(plant, train)) << "more can be coupled";
  train.trailers = 4;
  train.hitch_m = 1.0;
  const auto agrees = check_agrees(plant, train);
  ASSERT_FALSE(agrees);
  ASSERT_EQ(agrees.error().size(), 2u);
  EXPECT_EQ(agrees.error()[0].code, "L0504");
  EXPECT_EQ(agrees.error()[0].where.line, 30u);
  EXPECT_EQ(agrees.error()[0].message, "hitch_m of the simulated train is 1.4, and 1 of the problem's train");
  EXPECT_EQ(agrees.error()[1].where.line, 21u);
  config::PlantConfig none;
  none.kind = "none";
  EXPECT_TRUE(check_agrees(none, train));
}

TEST(TrainOfPlant, WhenThePlantCanDoLess_ThenThatIsTheLimit) {
  config::PlantConfig plant = tugger();
  plant.tugger.drive = {
      .top_speed_m_s = 0.8, .time_constant_s = 0.5, .acceleration_m_s2 = 0.4, .braking_m_s2 = 1.0};
  plant.tugger.steering = {.full_lock_rad = 0.6, .time_constant_s = 0.2, .rate_rad_s = 0.4};
  ltl::TrainModel train{.trailers = 3};
  keep_within(plant, train);
  EXPECT_EQ(train.most_speed_m_s, 0.8);
  EXPECT_EQ(train.most_acceleration_m_s2, 0.4);
  EXPECT_EQ(train.most_lock_rad, 0.6);
  EXPECT_EQ(train.most_lock_rate_rad_s, 0.4);
  EXPECT_EQ(train.trailers, 3u);
  train.most_lock_rad = 0.3;
  keep_within(plant, train);
  EXPECT_EQ(train.most_lock_rad, 0.3);
  const ltl::TrainDrive drive = drive_of(plant, 1.2);
  EXPECT_EQ(drive.top_speed_m_s, 0.8);
  EXPECT_EQ(drive.speed_up_m_s2, 0.2);
  EXPECT_EQ(drive.brake_m_s2, 0.25);
  EXPECT_EQ(drive.hard_brake_m_s2, 0.5);
  EXPECT_EQ(drive.lock_rate_rad_s, 0.2);
  EXPECT_EQ(drive.speed_lag_s, 0.5);
  EXPECT_EQ(drive.lock_lag_s, 0.2);
}

}  // namespace
}  // namespace stepwright::missions
