#pragma once

// Arms that follow a schedule, each as fast as it is told: what a controller does, without one. Planned times
// come from here, and tests of what late arms do.
//
// Belongs to one thread. The schedule must outlive it.
//
//   Replay replay(made);
//   while (!replay.done()) replay.advance(0.01, {1.0, 0.3});    // the second arm is slow
//   replay.joints(0);

#include <vector>

#include "supervisor/tamp/schedule/arm_schedule.h"

namespace stepwright::tamp::schedule {

class Replay {
 public:
  explicit Replay(const CellSchedule& schedule);

  // Each arm goes on by `step_s` of its own time at most, times its rate (0 to 1), as far as its waits allow.
  void advance(double step_s, const std::vector<double>& rates);

  bool done() const;
  // Nobody could go on, whatever the rates are.
  bool stuck() const;
  double progress(std::size_t arm) const { return at_[arm].progress; }
  // The step that it is at; the number of steps: it has finished.
  std::size_t step(std::size_t arm) const { return at_[arm].step; }
  motion::Configuration joints(std::size_t arm) const;
  double half_open_m(std::size_t arm) const;
  int holds(std::size_t arm) const;

 private:
  struct At {
    std::size_t step = 0;
    double time_s = 0.0;  // within it
    double progress = 0.0;
  };
  double reach_s(std::size_t arm) const;  // within its step, by its waits

  const CellSchedule& schedule_;
  std::vector<At> at_;
};

}  // namespace stepwright::tamp::schedule
