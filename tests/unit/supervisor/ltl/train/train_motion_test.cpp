#include "supervisor/ltl/train/train_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace stepwright::ltl {
namespace {

// Steps of a thousandth of a second by the classic rule of order 4, limits met to that much.
TrainState fine(const TrainModel& model, TrainState state, const TrainControl& control, double duration_s) {
  constexpr double kStep = 1e-3;
  for (double left = duration_s; left > 1e-12; left -= kStep) {
    const double h = std::min(kStep, left);
    TrainControl used = control;
    if (std::abs(state[kTrainSpeed]) >= model.most_speed_m_s &&
        used.acceleration_m_s2 * state[kTrainSpeed] > 0)
      used.acceleration_m_s2 = 0;
    if (std::abs(state[kTrainLock]) >= model.most_lock_rad && used.lock_rate_rad_s * state[kTrainLock] > 0)
      used.lock_rate_rad_s = 0;
    const auto after = [&](const TrainState& change, double share) {
      TrainState moved = state;
      for (std::size_t k = 0; k < kTrainStates; ++k) moved[k] += share * h * change[k];
      return moved;
    };
    const TrainState a = rate(model, state, used), b = rate(model, after(a, 0.5), used);
    const TrainState c = rate(model, after(b, 0.5), used), d = rate(model, after(c, 1.0), used);
    for (std::size_t k = 0; k < kTrainStates; ++k)
      state[k] += h / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]);
    state[kTrainSpeed] = std::clamp(state[kTrainSpeed], -model.most_speed_m_s, model.most_speed_m_s);
    state[kTrainLock] = std::clamp(state[kTrainLock], -model.most_lock_rad, model.most_lock_rad);
  }
  return state;
}

void drive(TrainMotion& motion, TrainState& state, const TrainControl& control, double duration_s) {
  for (double left = duration_s; left > 1e-12;) left -= motion.step(state, control, left);
}

TEST(TrainMotion, WhenControlsAreConstant_ThenItEndsWhereFineStepsEnd) {
  std::mt19937 dice(5);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (const HitchReading reading : {HitchReading::Pulled, HitchReading::Printed}) {
    for (const std::size_t trailers : {0, 5, 15}) {
      const TrainModel model{.trailers = trailers, .reading = reading};
      for (int round = 0; round < 10; ++round) {
        TrainState state = standing_at(model, {0.0, 0.0, any(dice)});
        state[kTrainSpeed] = 1.0 + any(dice);  // forward: in reverse trailers fold up, and nothing is near it
        state[kTrainLock] = 0.5 * any(dice);
        const TrainControl control{0.5 * any(dice) + 0.5, any(dice)};
        const TrainState wanted = fine(model, state, control, 2.0);
        TrainMotion motion(model);
        drive(motion, state, control, 2.0);
        for (std::size_t k = 0; k < model.states(); ++k) EXPECT_NEAR(state[k], wanted[k], 2e-3) << k;
      }
    }
  }
}

TEST(TrainMotion, WhenItTurnsForLong_ThenEachTrailerFollowsItsCircle) {
  const TrainModel model{.trailers = 4, .hitch_m = 0.7, .wheelbase_m = 1.0};
  TrainState state = standing_at(model, {0.0, 0.0, 0.0});
  state[kTrainSpeed] = 1.0;
  state[kTrainLock] = 0.2;
  TrainMotion motion(model);
  drive(motion, state, {}, 200.0);
  // Each axle moves on a circle around the same middle: r[i]^2 = r[i-1]^2 - d^2.
  double radius = model.wheelbase_m / std::tan(0.2);
  double front = state[kTrainHeading];
  for (std::size_t k = 0; k < model.trailers; ++k) {
    const double expected = std::asin(model.hitch_m / radius);
    EXPECT_NEAR(std::remainder(front - state[kTrainTrailer + k], 6.283185307179586), expected, 1e-4) << k;
    radius = std::sqrt(radius * radius - model.hitch_m * model.hitch_m);
    front = state[kTrainTrailer + k];
  }
}

TEST(TrainMotion, WhenALimitIsMet_ThenTheStateStaysAtIt) {
  const TrainModel model{.trailers = 1};
  TrainState state = standing_at(model, {0.0, 0.0, 0.0});
  TrainMotion motion(model);
  drive(motion, state, {5.0, -5.0}, 10.0);  // beyond what the model can do, too
  EXPECT_DOUBLE_EQ(state[kTrainSpeed], model.most_speed_m_s);
  EXPECT_DOUBLE_EQ(state[kTrainLock], -model.most_lock_rad);
  drive(motion, state, {-1.0, 1.0}, 0.5);
  EXPECT_NEAR(state[kTrainSpeed], 1.5, 1e-9);
  EXPECT_NEAR(state[kTrainLock], -0.5, 1e-9);
}

TEST(TrainMotion, WhenItIsFast_ThenNoStepIsLongerThanWanted) {
  const TrainModel model{.trailers = 15};
  TrainState state = standing_at(model, {0.0, 0.0, 0.0});
  state[kTrainSpeed] = 2.0;
  TrainMotion motion(model, 1e-6, 0.05);
  for (double left = 3.0; left > 1e-12;) {
    const TrainState before = state;
    left -= motion.step(state, {1.0, 0.2}, left);
    EXPECT_LE(std::hypot(state[kTrainX] - before[kTrainX], state[kTrainY] - before[kTrainY]), 0.05 + 1e-9);
  }
  EXPECT_GE(motion.steps(), 119u);
}

}  // namespace
}  // namespace stepwright::ltl
