#pragma once

// A train driven by constant controls: adaptive steps of J. R. Dormand and P. J. Prince, A family of embedded
// Runge-Kutta formulae (1980), of orders 5 and 4. Speed and steering stop at their limits, at the instant at
// which they meet them.
//
// Thread rule: one thread at a time. Example:
//   TrainMotion motion(model);
//   for (double left_s = 1.0; left_s > 0.0;) {
//     left_s -= motion.step(state, control, left_s);
//     if (!valid(state)) break;                        // each state that a step ends in
//   }

#include "supervisor/ltl/train/train_model.h"

namespace stepwright::ltl {

class TrainMotion {
 public:
  // `tolerance` of each state's error in a step, absolute; `most_step_m` bounds the way of one step, so that
  // who looks at the states that steps end in misses no more than that. The model must outlive it.
  explicit TrainMotion(const TrainModel& model, double tolerance = 1e-6, double most_step_m = 0.1);

  // One step, of `most_s` at most; returns its length, which is greater than 0. Requires most_s > 0 and a
  // finite state within the limits.
  double step(TrainState& state, const TrainControl& control, double most_s);

  // What of a control has an effect in that state: the parts that lead beyond a limit are nothing.
  TrainControl within_limits(const TrainState& state, const TrainControl& control) const;

  std::uint64_t steps() const { return steps_; }

 private:
  double until_limit(const TrainState& state, const TrainControl& control, double most_s) const;
  double attempt(const TrainState& state, const TrainControl& control, double length_s,
                 TrainState& next) const;
  void clamp(TrainState& state) const;

  const TrainModel& model_;
  double tolerance_;
  double most_step_m_;
  double next_s_ = 0.05;
  std::uint64_t steps_ = 0;
};

}  // namespace stepwright::ltl
