#include "supervisor/ltl/train/train_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "supervisor/geometry/convex_polygon.h"

namespace stepwright::ltl {
namespace {

// The paper's equations as they are printed, with the product written out.
double printed(const TrainModel& model, const TrainState& s, std::size_t i) {
  const auto heading = [&](std::size_t k) { return k == 0 ? s[kTrainHeading] : s[kTrainTrailer + k - 1]; };
  double product = 1.0;
  for (std::size_t j = 1; j < i; ++j) product *= std::cos(heading(j - 1) - heading(j));
  return s[kTrainSpeed] / model.hitch_m * product * (std::sin(heading(i - 1)) - std::sin(heading(i)));
}

TrainState random_state(std::mt19937& dice, const TrainModel& model) {
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  TrainState state{};
  for (std::size_t k = 0; k < model.states(); ++k) state[k] = any(dice);
  return state;
}

TEST(TrainModel, WhenReadAsPrinted_ThenTheRatesAreThePapers) {
  std::mt19937 dice(1);
  const TrainModel model{.trailers = 6, .reading = HitchReading::Printed, .hitch_m = 0.05};
  for (int round = 0; round < 200; ++round) {
    const TrainState state = random_state(dice, model);
    const TrainState change = rate(model, state, {0.3, -0.2});
    EXPECT_DOUBLE_EQ(change[kTrainX], state[kTrainSpeed] * std::cos(state[kTrainHeading]));
    EXPECT_DOUBLE_EQ(change[kTrainHeading], state[kTrainSpeed] * std::tan(state[kTrainLock]));
    EXPECT_DOUBLE_EQ(change[kTrainSpeed], 0.3);
    EXPECT_DOUBLE_EQ(change[kTrainLock], -0.2);
    for (std::size_t i = 1; i <= model.trailers; ++i)
      EXPECT_NEAR(change[kTrainTrailer + i - 1], printed(model, state, i), 1e-12);
  }
}

// The wheels of a trailer roll and do not slide: its axle moves along its own heading.
TEST(TrainModel, WhenTrailersArePulled_ThenNoAxleMovesSideways) {
  std::mt19937 dice(2);
  const TrainModel model{.trailers = 8, .hitch_m = 0.8, .spacing_m = 0.8};
  for (int round = 0; round < 200; ++round) {
    const TrainState state = random_state(dice, model);
    const TrainState change = rate(model, state, {});
    geometry::Point moves{change[kTrainX], change[kTrainY]};
    for (std::size_t k = 0; k < model.trailers; ++k) {
      const double heading = state[kTrainTrailer + k];
      const geometry::Point aside{-std::sin(heading), std::cos(heading)};
      // The axle lies `hitch_m` behind the one in front.
      moves = moves - model.hitch_m * change[kTrainTrailer + k] * aside;
      EXPECT_NEAR(dot(moves, aside), 0.0, 1e-12);
    }
  }
}

TEST(TrainModel, WhenItDrivesStraight_ThenNothingTurns) {
  const TrainModel model{.trailers = 15};
  TrainState state = standing_at(model, {1.0, 2.0, 0.7});
  state[kTrainSpeed] = -1.5;
  const TrainState change = rate(model, state, {});
  for (std::size_t k = kTrainHeading; k < kTrainStates; ++k) EXPECT_EQ(change[k], 0.0) << k;
}

TEST(TrainModel, WhenLinksAreBoxes_ThenTheyOverlapAsPolygonsDo) {
  std::mt19937 dice(3);
  std::uniform_real_distribution<double> near(-1.2, 1.2), angle(-3.1, 3.1);
  const TrainModel model{.length_m = 1.1, .width_m = 0.6};
  const geometry::Footprint half{0.55, 0.55, 0.3};
  int met = 0;
  for (int round = 0; round < 20'000; ++round) {
    const geometry::Pose a{near(dice), near(dice), angle(dice)}, b{near(dice), near(dice), angle(dice)};
    const auto box = [](const geometry::Pose& pose) {
      return LinkBox{pose.position(), {std::cos(pose.heading_rad), std::sin(pose.heading_rad)}};
    };
    const bool meet = overlaps(model, box(a), box(b));
    EXPECT_EQ(meet, geometry::overlaps(footprint_at(a, half), footprint_at(b, half)));
    met += meet ? 1 : 0;
  }
  EXPECT_GT(met, 2'000);
  EXPECT_LT(met, 18'000);
}

TEST(TrainModel, WhenItBitesItsTail_ThenThatIsSeenAndNeighboursDoNotCount) {
  const TrainModel model{.trailers = 6, .length_m = 1.0, .spacing_m = 0.9};
  TrainState state = standing_at(model, {0.0, 0.0, 0.0});
  EXPECT_FALSE(meets_itself(model, link_boxes(model, state)));  // neighbours overlap by 0.1 m
  for (std::size_t k = 0; k < model.trailers; ++k)
    state[kTrainTrailer + k] = 1.1 * static_cast<double>(k + 1);  // round and round
  EXPECT_TRUE(meets_itself(model, link_boxes(model, state)));
}

TEST(TrainModel, WhenFiguresHaveNoSense_ThenAllAreNamed) {
  TrainModel model{.trailers = 16, .hitch_m = 0.0, .length_m = -1.0, .most_lock_rad = 1.6};
  model.width_m = std::numeric_limits<double>::quiet_NaN();
  const auto wrong = validate(model);
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().size(), 5u);
  for (const auto& problem : wrong.error()) EXPECT_EQ(problem.code, "L0301");
  EXPECT_TRUE(validate({}));
}

}  // namespace
}  // namespace stepwright::ltl
