#include "supervisor/tamp/pictures/thing_stages.h"

#include <algorithm>
#include <tuple>

namespace stepwright::tamp::pictures {
namespace {

using motion::Transform;
using schedule::ScheduledStep;
using schedule::StepKind;
using Stage = ArmsPicture::Stage;

// A hand that takes something or lets it go.
struct Event {
  double finish_s = 0.0;
  std::size_t arm = 0;
  std::size_t step = 0;
  motion::Configuration joints;  // of the arm meanwhile
};

std::vector<Event> events_of(const schedule::CellSchedule& schedule) {
  std::vector<Event> all;
  for (std::size_t arm = 0; arm < schedule.arms.size(); ++arm) {
    motion::Configuration joints = schedule.arms[arm].start;
    const auto& steps = schedule.arms[arm].steps;
    for (std::size_t k = 0; k < steps.size(); ++k) {
      if (steps[k].motion) joints = steps[k].motion->path.points().back();
      if (steps[k].kind == StepKind::Grip || steps[k].kind == StepKind::Release)
        all.push_back({steps[k].finish_s, arm, k, joints});
    }
  }
  std::ranges::sort(all, {}, [](const Event& one) { return std::tuple(one.finish_s, one.arm, one.step); });
  return all;
}

// Where a thing is in the frame that carries it.
struct Carried {
  int arm = -1;  // -1: it stands, and the place is in the cell
  Transform place;
};

Carried beginning(const scene::RobotCell& cell, const scene::ThingState& thing, std::size_t number) {
  if (thing.holder < 0) return {-1, scene::frame_of(thing.pose)};
  const Transform tool =
      scene::tool_pose(0.0, 0.0, cell.tool_above(static_cast<int>(number)), thing.hand_rad);
  return {thing.holder, inverse(tool)};
}

Stage stage_of(const scene::RobotCell& cell, const Carried& now, int arm, double from) {
  const int frame = now.arm < 0 ? -1 : cell.arms[static_cast<std::size_t>(now.arm)].tip;
  return {.arm = arm, .from = from, .frame = frame, .place = drawn(now.place)};
}

}  // namespace

PicturePlace drawn(const Transform& place) {
  return {place.rotation.m, {place.position_m.x, place.position_m.y, place.position_m.z}};
}

std::vector<std::vector<Stage>> thing_stages(const scene::RobotCell& cell, const scene::GeometricState& start,
                                             const schedule::CellSchedule* schedule) {
  std::vector<Carried> now;
  std::vector<std::vector<Stage>> all(cell.things.size());
  for (std::size_t k = 0; k < cell.things.size(); ++k) {
    now.push_back(beginning(cell, start.things[k], k));
    all[k].push_back(stage_of(cell, now[k], -1, 0.0));
  }
  if (schedule == nullptr) return all;
  for (const Event& each : events_of(*schedule)) {
    const ScheduledStep& step = schedule->arms[each.arm].steps[each.step];
    if (step.thing < 0) continue;
    const auto thing = static_cast<std::size_t>(step.thing);
    const scene::ArmModel& arm = cell.arms[each.arm];
    const Transform tool = arm.base * arm.chain.forward(each.joints);
    const bool takes = step.kind == StepKind::Grip;
    Carried& it = now[thing];
    if (takes == (it.arm >= 0)) continue;
    it = takes ? Carried{static_cast<int>(each.arm), inverse(tool) * it.place} : Carried{-1, tool * it.place};
    all[thing].push_back(stage_of(cell, it, static_cast<int>(each.arm), static_cast<double>(each.step + 1)));
  }
  return all;
}

}  // namespace stepwright::tamp::pictures
