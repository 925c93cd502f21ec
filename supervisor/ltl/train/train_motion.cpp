#include "supervisor/ltl/train/train_motion.h"

#include <algorithm>
#include <cmath>

namespace stepwright::ltl {

namespace {

constexpr double kLeast_s = 1e-6;
constexpr double kMost_s = 0.5;
constexpr double kSafety = 0.9;

// The coefficients of the pair; the last row of weights is that of order 5, the errors are the difference to
// order 4.
constexpr double kWeights[6][6] = {
    {1.0 / 5.0},
    {3.0 / 40.0, 9.0 / 40.0},
    {44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0},
    {19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0},
    {9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0},
    {35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0},
};
constexpr double kErrors[7] = {71.0 / 57600.0,      0.0,          -71.0 / 16695.0, 71.0 / 1920.0,
                               -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0};

// A control that leads out of the limit does nothing there.
double held(double value, double most, double control) {
  const bool at_limit = std::abs(value) >= most;
  return at_limit && control * value > 0.0 ? 0.0 : control;
}

// When `value` meets its limit under a constant rate.
double meets_after(double value, double most, double rate) {
  if (rate == 0.0) return kMost_s;
  return ((rate > 0.0 ? most : -most) - value) / rate;
}

}  // namespace

TrainMotion::TrainMotion(const TrainModel& model, double tolerance, double most_step_m)
    : model_(model), tolerance_(tolerance), most_step_m_(most_step_m) {}

TrainControl TrainMotion::within_limits(const TrainState& state, const TrainControl& control) const {
  const double acceleration =
      std::clamp(control.acceleration_m_s2, -model_.most_acceleration_m_s2, model_.most_acceleration_m_s2);
  const double lock_rate =
      std::clamp(control.lock_rate_rad_s, -model_.most_lock_rate_rad_s, model_.most_lock_rate_rad_s);
  return {held(state[kTrainSpeed], model_.most_speed_m_s, acceleration),
          held(state[kTrainLock], model_.most_lock_rad, lock_rate)};
}

double TrainMotion::until_limit(const TrainState& state, const TrainControl& control, double most_s) const {
  double length = std::min(most_s, kMost_s);
  length =
      std::min(length, meets_after(state[kTrainSpeed], model_.most_speed_m_s, control.acceleration_m_s2));
  length = std::min(length, meets_after(state[kTrainLock], model_.most_lock_rad, control.lock_rate_rad_s));
  // No further than most_step_m, however much faster it becomes.
  const double fastest = std::abs(state[kTrainSpeed]) + std::abs(control.acceleration_m_s2) * length;
  if (fastest * length > most_step_m_) length = most_step_m_ / fastest;
  return std::min(most_s, std::max(length, kLeast_s));
}

double TrainMotion::attempt(const TrainState& state, const TrainControl& control, double length_s,
                            TrainState& next) const {
  const std::size_t count = model_.states();
  std::array<TrainState, 7> rates;
  rates[0] = rate(model_, state, control);
  for (std::size_t stage = 0; stage < 6; ++stage) {
    next = state;
    for (std::size_t j = 0; j <= stage; ++j)
      for (std::size_t i = 0; i < count; ++i) next[i] += length_s * kWeights[stage][j] * rates[j][i];
    rates[stage + 1] = rate(model_, next, control);
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    double error = 0.0;
    for (std::size_t j = 0; j < 7; ++j) error += kErrors[j] * rates[j][i];
    worst = std::max(worst, std::abs(length_s * error));
  }
  return worst / tolerance_;
}

void TrainMotion::clamp(TrainState& state) const {
  state[kTrainSpeed] = std::clamp(state[kTrainSpeed], -model_.most_speed_m_s, model_.most_speed_m_s);
  state[kTrainLock] = std::clamp(state[kTrainLock], -model_.most_lock_rad, model_.most_lock_rad);
}

double TrainMotion::step(TrainState& state, const TrainControl& control, double most_s) {
  const TrainControl used = within_limits(state, control);
  const double most = until_limit(state, used, most_s);
  double length = std::min(next_s_, most);
  TrainState next;
  while (true) {
    const double error = attempt(state, used, length, next);
    const double factor = error > 0.0 ? kSafety * std::pow(error, -0.2) : 5.0;
    // Not finite counts as too long.
    if (error <= 1.0 || length <= kLeast_s) {
      // What a limit cut short says nothing of the next step.
      if (length >= next_s_ || factor < 1.0)
        next_s_ = std::clamp(length * std::min(factor, 5.0), kLeast_s, kMost_s);
      break;
    }
    length = std::max(kLeast_s, length * std::clamp(std::isfinite(factor) ? factor : 0.2, 0.2, 0.9));
  }
  clamp(next);
  state = next;
  ++steps_;
  return length;
}

}  // namespace stepwright::ltl
