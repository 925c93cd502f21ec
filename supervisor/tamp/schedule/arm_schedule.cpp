#include "supervisor/tamp/schedule/arm_schedule.h"

#include <algorithm>

namespace stepwright::tamp::schedule {

const char* name_of(StepKind kind) {
  switch (kind) {
    case StepKind::Fingers:
      return "fingers";
    case StepKind::Approach:
      return "approach";
    case StepKind::Linear:
      return "linear";
    case StepKind::Grip:
      return "grip";
    case StepKind::Lift:
      return "lift";
    case StepKind::Transfer:
      return "transfer";
    case StepKind::Lower:
      return "lower";
    case StepKind::Release:
      break;
  }
  return "release";
}

std::size_t CellSchedule::steps() const {
  std::size_t sum = 0;
  for (const ArmSchedule& arm : arms) sum += arm.steps.size();
  return sum;
}

std::size_t CellSchedule::waits() const {
  std::size_t sum = 0;
  for (const ArmSchedule& arm : arms)
    for (const ScheduledStep& each : arm.steps) sum += each.waits.size();
  return sum;
}

std::size_t CellSchedule::most_rows() const {
  std::size_t most = 0;
  for (const ArmSchedule& arm : arms)
    for (const ScheduledStep& each : arm.steps)
      if (each.motion) most = std::max(most, each.motion->table.rows());
  return most;
}

std::size_t CellSchedule::total_rows() const {
  std::size_t sum = 0;
  for (const ArmSchedule& arm : arms)
    for (const ScheduledStep& each : arm.steps)
      if (each.motion) sum += each.motion->table.rows();
  return sum;
}

}  // namespace stepwright::tamp::schedule
