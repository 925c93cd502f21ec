#include "supervisor/tamp/schedule/replay.h"

#include <algorithm>

namespace stepwright::tamp::schedule {

Replay::Replay(const CellSchedule& schedule) : schedule_(schedule), at_(schedule.arms.size()) {}

// Without limits of its own the step's whole duration.
double Replay::reach_s(std::size_t arm) const {
  const ScheduledStep& step = schedule_.arms[arm].steps[at_[arm].step];
  for (const Wait& each : step.waits)
    if (at_[each.other].progress < each.progress) return each.at * step.duration_s;
  return step.duration_s;
}

void Replay::advance(double step_s, const std::vector<double>& rates) {
  // What an arm has come to counts for the others from the next call on, as in a controller's scan.
  std::vector<At> next = at_;
  for (std::size_t arm = 0; arm < at_.size(); ++arm) {
    const ArmSchedule& mine = schedule_.arms[arm];
    double left_s = step_s * rates[arm];
    while (next[arm].step < mine.steps.size()) {
      At& now = next[arm];
      at_[arm].step = now.step;  // reach_s looks at the step that it is in by now
      const double duration_s = mine.steps[now.step].duration_s;
      const double reach = std::max(now.time_s, reach_s(arm));
      const double go = std::min(left_s, reach - now.time_s);
      now.time_s += go;
      left_s -= go;
      if (now.time_s < duration_s || reach < duration_s) {
        now.progress = static_cast<double>(now.step) + now.time_s / duration_s;
        break;
      }
      now = {now.step + 1, 0.0, static_cast<double>(now.step + 1)};
    }
  }
  at_ = std::move(next);
}

bool Replay::done() const {
  for (std::size_t arm = 0; arm < at_.size(); ++arm)
    if (at_[arm].step < schedule_.arms[arm].steps.size()) return false;
  return true;
}

bool Replay::stuck() const {
  if (done()) return false;
  for (std::size_t arm = 0; arm < at_.size(); ++arm)
    if (at_[arm].step < schedule_.arms[arm].steps.size()) {
      const bool waits_at_start = at_[arm].time_s >= reach_s(arm);
      if (!waits_at_start) return false;
    }
  return true;
}

motion::Configuration Replay::joints(std::size_t arm) const {
  const ArmSchedule& mine = schedule_.arms[arm];
  // Where the last motion so far has brought it.
  for (std::size_t k = std::min(at_[arm].step + 1, mine.steps.size()); k > 0; --k) {
    const ScheduledStep& step = mine.steps[k - 1];
    if (!step.motion) continue;
    if (k - 1 < at_[arm].step) return step.motion->path.points().back();
    motion::Configuration joints(step.motion->path.joints());
    step.motion->path.at(step.motion->law.at(at_[arm].time_s).place, joints);
    return joints;
  }
  return mine.start;
}

double Replay::half_open_m(std::size_t arm) const {
  const ArmSchedule& mine = schedule_.arms[arm];
  for (std::size_t k = std::min(at_[arm].step + 1, mine.steps.size()); k > 0; --k) {
    const ScheduledStep& step = mine.steps[k - 1];
    if (step.motion || k - 1 < at_[arm].step) return step.half_open_m;
  }
  return mine.half_open_m;
}

int Replay::holds(std::size_t arm) const {
  const ArmSchedule& mine = schedule_.arms[arm];
  int held = mine.holds;
  for (std::size_t k = 0; k < at_[arm].step; ++k) {
    if (mine.steps[k].kind == StepKind::Grip) held = mine.steps[k].thing;
    if (mine.steps[k].kind == StepKind::Release) held = -1;
  }
  return held;
}

}  // namespace stepwright::tamp::schedule
