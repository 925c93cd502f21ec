#include "plant_models/assemblies/tugger_train.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "supervisor/ltl/train/train_model.h"
#include "tests/support/malloc_guard.h"

namespace stepwright::assemblies {
namespace {

constexpr double kScanS = 0.01;

// Without slip, so that the way is the command's.
TuggerParameters ideal(std::size_t trailers) {
  TuggerParameters parameters;
  parameters.trailers = trailers;
  parameters.slip = TuggerSlip::none();
  return parameters;
}

std::unique_ptr<TuggerTrain> make(const TuggerParameters& parameters) {
  return TuggerTrain::create(parameters).value();
}

void run(TuggerTrain& train, double& t_s, double seconds) {
  const double end = t_s + seconds;
  while (t_s < end - 1e-9) ASSERT_TRUE(train.advance_to(t_s += kScanS));
}

using State = std::array<double, kMostTuggerStates>;

// One step of Runge and Kutta's method of order four.
template <typename Slope>
State runge_kutta(const State& y, double h, const Slope& slope) {
  const auto moved = [](State at, const State& d, double by) {
    for (std::size_t i = 0; i < at.size(); ++i) at[i] += by * d[i];
    return at;
  };
  const State a = slope(y);
  const State b = slope(moved(y, a, h / 2));
  const State c = slope(moved(y, b, h / 2));
  const State d = slope(moved(y, c, h));
  State next = y;
  for (std::size_t i = 0; i < y.size(); ++i) next[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
  return next;
}

// Steps of 0.2 ms as the truth.
TEST(TuggerTrain, WhenCommandsChangeAllTheTime_ThenTheStateIsThatOfAFineIntegration) {
  TuggerParameters parameters;
  parameters.trailers = 5;
  auto train = make(parameters);
  TuggerEquations truth(parameters);
  State y{};
  constexpr double kStepS = 2e-4;
  for (int scan = 0; scan < 1500; ++scan) {
    const double t_s = scan * kScanS;
    train->command(scan % 400 != 399, 0.6 + 1.2 * std::sin(0.7 * t_s), 0.6 * std::cos(1.3 * t_s));
    truth.modes = train->modes();
    truth.coupled = train->coupled();
    ASSERT_TRUE(train->advance_to((scan + 1) * kScanS));
    for (int k = 0; k < 50; ++k) {
      y = runge_kutta(y, kStepS, [&](const State& at) {
        State d{};
        truth.derivative(0.0, at, d);
        return d;
      });
    }
    for (std::size_t i = 0; i < train->state().size(); ++i)
      ASSERT_NEAR(train->state()[i], y[i], 2e-4) << scan << " " << i;
  }
}

// Drives and steering that follow at once, so that both are told the same speed and the same steering.
TEST(TuggerTrain, WhenNothingLagsOrSlips_ThenLinksMoveAsThePlannersEquationsSay) {
  TuggerParameters parameters = ideal(5);
  parameters.drive.time_constant_s = 2e-3;
  parameters.drive.acceleration_m_s2 = 1e3;
  parameters.drive.braking_m_s2 = 1e3;
  parameters.steering.time_constant_s = 2e-3;
  parameters.steering.rate_rad_s = 1e3;
  auto train = make(parameters);
  const ltl::TrainModel model{.trailers = 5};
  ltl::TrainState planned = ltl::standing_at(model, {0.0, 0.0, 0.0});
  constexpr double kStepS = 1e-3;
  for (int scan = 0; scan < 1000; ++scan) {
    const double t_s = scan * kScanS;
    const double speed = 1.0 + 0.5 * std::sin(0.5 * t_s);
    const double lock = 0.5 * std::sin(0.8 * t_s);
    train->command(true, speed, lock);
    ASSERT_TRUE(train->advance_to((scan + 1) * kScanS));
    planned[ltl::kTrainSpeed] = speed;
    planned[ltl::kTrainLock] = lock;
    for (int k = 0; k < 10; ++k) {
      const ltl::TrainState first = ltl::rate(model, planned, {});
      ltl::TrainState half = planned;
      for (std::size_t i = 0; i < half.size(); ++i) half[i] += 0.5 * kStepS * first[i];
      const ltl::TrainState middle = ltl::rate(model, half, {});
      for (std::size_t i = 0; i < planned.size(); ++i) planned[i] += kStepS * middle[i];
    }
  }
  EXPECT_NEAR(train->state()[kBicycleX], planned[ltl::kTrainX], 0.03);
  EXPECT_NEAR(train->state()[kBicycleY], planned[ltl::kTrainY], 0.03);
  for (std::size_t link = 1; link <= 5; ++link)
    EXPECT_NEAR(train->heading_rad(link), planned[ltl::kTrainTrailer + link - 1], 0.01) << link;
  const ltl::LinkBoxes boxes = ltl::link_boxes(model, planned);
  EXPECT_NEAR(train->boxes()[5].middle.x, boxes[5].middle.x_m, 0.03);
  EXPECT_NEAR(train->boxes()[5].middle.y, boxes[5].middle.y_m, 0.03);
}

// Exactly, without integration: the same rates in the same state.
TEST(TuggerTrain, WhenThereIsNoHitchSlip_ThenRatesAreThePlannersToTheLastBits) {
  const TuggerParameters parameters = ideal(7);
  TuggerEquations equations(parameters);
  equations.coupled = 7;
  const ltl::TrainModel model{.trailers = 7};
  ltl::TrainState planned{};
  State y{};
  y[kBicycleWheel] = planned[ltl::kTrainSpeed] = -1.3;
  y[kBicycleLock] = planned[ltl::kTrainLock] = 0.7;
  y[kBicycleHeading] = planned[ltl::kTrainHeading] = 0.4;
  for (std::size_t k = 0; k < 7; ++k)
    y[kTuggerTrailer + k] = planned[ltl::kTrainTrailer + k] = 0.4 - 0.2 * static_cast<double>(k * k % 5);
  State d{};
  equations.derivative(0.0, y, d);
  const ltl::TrainState rate = ltl::rate(model, planned, {});
  EXPECT_NEAR(d[kBicycleHeading], rate[ltl::kTrainHeading], 1e-15);
  for (std::size_t k = 0; k < 7; ++k)
    EXPECT_NEAR(d[kTuggerTrailer + k], rate[ltl::kTrainTrailer + k], 1e-15) << k;
}

// In a steady turn the axle of each trailer is on a circle whose radius is a leg to that of the one in front.
TEST(TuggerTrain, WhenItTurnsSteadily_ThenEachTrailerIsOnItsCircle) {
  auto train = make(ideal(5));
  const double lock = std::atan(1.0 / 6.0);  // a circle of 6 m
  train->command(true, 1.0, lock);
  double t_s = 0.0;
  run(*train, t_s, 120.0);
  EXPECT_NEAR(train->curvature_1_m(), 1.0 / 6.0, 1e-6);
  double before = 6.0;
  for (std::size_t k = 1; k <= 5; ++k) {
    const double radius = std::sqrt(before * before - 1.0);
    EXPECT_NEAR(train->hitch_rad(k), std::asin(1.0 / before), 1e-4) << k;
    before = radius;
  }
}

TEST(TuggerTrain, WhenHitchesSlip_ThenTrailersRunWider) {
  TuggerParameters parameters = ideal(1);
  parameters.slip.hitch_slip_s2_m2 = 0.1;
  auto train = make(parameters);
  train->command(true, 1.5, std::atan(1.0 / 6.0));
  double t_s = 0.0;
  run(*train, t_s, 40.0);
  EXPECT_NEAR(std::sin(train->hitch_rad(1)), 1.0 / 6.0 / (1.0 + 0.1 * 1.5 * 1.5), 1e-4);
}

TEST(TuggerTrain, WhenItStarts_ThenItsForceMovesAllTrailersAsNamedAndFewerFaster) {
  const auto way_in_a_second = [](std::size_t trailers) {
    TuggerParameters parameters = ideal(trailers);
    parameters.most_trailers = 5;
    parameters.drive.time_constant_s = 0.02;  // the force decides
    auto train = make(parameters);
    train->command(true, 2.0, 0.0);
    double t_s = 0.0;
    run(*train, t_s, 1.0);
    return train->state()[kBicycleX];
  };
  EXPECT_NEAR(way_in_a_second(5), 0.5, 1e-3);
  EXPECT_NEAR(way_in_a_second(3), 0.5 * 1050.0 / 750.0, 1e-3);
}

TEST(TuggerTrain, WhenTheDriveIsDisabled_ThenTheSpringBrakeStopsIt) {
  auto train = make(ideal(5));
  train->command(true, 2.0, 0.0);
  double t_s = 0.0;
  run(*train, t_s, 6.0);
  const double x_m = train->state()[kBicycleX];
  train->command(false, 2.0, 0.3);
  run(*train, t_s, 3.0);
  EXPECT_NEAR(train->speed_m_s(), 0.0, 1e-6);
  EXPECT_NEAR(train->state()[kBicycleX] - x_m, 2.0 * 2.0 / 2.0 / 2.5, 0.06);
  EXPECT_NEAR(train->state()[kBicycleLock], 0.0, 1e-9);  // no power, no steering
}

TEST(TuggerTrain, WhenTrailersAreUncoupled_ThenTheyStayAndNewOnesComeInLine) {
  TuggerParameters parameters = ideal(3);
  parameters.most_trailers = 4;
  auto train = make(parameters);
  train->command(true, 1.0, 0.4);
  double t_s = 0.0;
  run(*train, t_s, 3.0);
  train->couple(1);
  EXPECT_EQ(train->boxes().size(), 2u);
  EXPECT_EQ(train->modes().load_kg, 150.0);
  const double second = train->heading_rad(2);
  run(*train, t_s, 2.0);
  EXPECT_EQ(train->heading_rad(2), second);
  train->couple(4);
  ASSERT_EQ(train->boxes().size(), 5u);
  for (std::size_t link = 2; link <= 4; ++link) EXPECT_EQ(train->heading_rad(link), train->heading_rad(1));
  EXPECT_NEAR(std::hypot(train->boxes()[4].middle.x - train->boxes()[1].middle.x,
                         train->boxes()[4].middle.y - train->boxes()[1].middle.y),
              3.0, 1e-9);
}

TEST(TuggerTrain, WhenTimeIsSlicedFiner_ThenTheStateIsBitIdentical) {
  const auto end = [](int slices) {
    auto train = make({});
    for (int scan = 0; scan < 500; ++scan) {
      if (scan % 3 == 0) train->command(true, 0.01 * (scan % 150), 0.002 * (scan % 300) - 0.3);
      for (int k = 1; k <= slices; ++k)
        train->advance_to(scan == 499 && k == slices ? 5.0 : (scan + 1.0 * k / slices) * kScanS);
    }
    return std::vector<double>(train->state().begin(), train->state().end());
  };
  EXPECT_EQ(end(1), end(4));
}

TEST(TuggerTrain, WhenFiguresMakeNoSense_ThenEachIsNamed) {
  TuggerParameters parameters;
  parameters.links.hitch_m = 0.0;
  parameters.links.width_m = -1.0;
  parameters.links.spacing_m = 0.4;
  parameters.drive.tractor_kg = std::numeric_limits<double>::quiet_NaN();
  parameters.steering.full_lock_rad = 1.6;
  parameters.slip.drive_slip = 1.0;
  parameters.trailers = 16;
  parameters.start.position.x = 321.0;
  parameters.walls = {{"", {{0, 0}, {2, 2}, {2, 0}, {0, 2}}}};
  parameters.places = {{"dock", {{0, 0}, {1, 0}, {1, 1}}}, {"DOCK", {{0, 0}, {1, 0}, {1, 1}}}};
  const auto train = TuggerTrain::create(parameters);
  ASSERT_FALSE(train);
  EXPECT_EQ(train.error().size(), 10u) << result::to_string(train.error());
  for (const auto& problem : train.error()) EXPECT_EQ(problem.code, "C0321");
}

TEST(TuggerTrain, WhenRunning_ThenNothingIsAllocated) {
  if (!support::guard_is_active()) GTEST_SKIP() << "a sanitizer owns the allocator";
  auto train = make({});
  const support::GuardCounts before = support::guard_counts();
  for (int scan = 0; scan < 1000; ++scan) {
    train->command(true, 0.001 * scan, 0.1);
    train->advance_to((scan + 1) * kScanS);
  }
  EXPECT_EQ(support::guard_counts(), before);
}

}  // namespace
}  // namespace stepwright::assemblies
