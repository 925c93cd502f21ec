#include "supervisor/tamp/schedule/schedule_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "supervisor/motion/blend/blend.h"
#include "supervisor/motion/recheck/exact_checker.h"
#include "supervisor/motion/timing/plan_timing.h"
#include "supervisor/tamp/schedule/arm_capsules.h"
#include "supervisor/tamp/schedule/arm_locks.h"
#include "supervisor/tamp/schedule/keep_clear.h"
#include "supervisor/tamp/schedule/replay.h"
#include "supervisor/tamp/schedule/straight_line.h"

namespace stepwright::tamp::schedule {

namespace {

constexpr double kHeldShrunk_m = 2e-4;  // what is held touches what it stands on
constexpr double kSamePlace_rad = 5e-7;
constexpr double kLineBlend_rad = 0.03;
constexpr double kPlannedStep_s = 0.005;
constexpr double kWorthIt_m = 0.002;  // of room, for a slower motion

std::size_t index(int number) {
  return static_cast<std::size_t>(number);
}

StepKind kind_of(scene::Phase phase, bool holds) {
  if (phase == scene::Phase::Transfer) return holds ? StepKind::Transfer : StepKind::Approach;
  if (!holds) return StepKind::Linear;
  return phase == scene::Phase::Lift ? StepKind::Lift : StepKind::Lower;
}

motion::JointPath without_repetitions(const motion::JointPath& path) {
  constexpr double kRepeated_rad = 1e-6;
  motion::JointPath made;
  for (const motion::Configuration& each : path)
    if (made.empty() || motion::joint_distance(made.back(), each) > kRepeated_rad) made.push_back(each);
  // The end is what the next motion begins with.
  if (made.size() > 1) made.back() = path.back();
  return made;
}

class Scheduler {
 public:
  Scheduler(const scene::RobotCell& cell, const scene::GeometricState& start, const scene::TampPlan& plan,
            const ScheduleOptions& options)
      : cell_(cell), state_(start), plan_(plan), options_(options), capsules_(cell.arms.size()) {
    for (std::size_t arm = 0; arm < cell.arms.size(); ++arm) {
      bare_.push_back(arm_capsules(cell, arm));
      const scene::ArmState& at = start.arms[arm];
      made_.arms.push_back({{at.at.begin(), at.at.end()}, at.half_open_m, at.holds, held_by(arm), {}});
      // Nobody knows how far empty fingers are open before they were told.
      opening_m_.push_back(at.holds >= 0 ? at.half_open_m : -1.0);
    }
    made_.nearest_m = std::numeric_limits<double>::infinity();
  }

  result::Result<CellSchedule> run() {
    if (auto good = find_limits(); !good) return result::forward(good);
    for (std::size_t k = 0; k < plan_.actions.size(); ++k)
      if (auto done = add_action(k); !done) return result::forward(done);
    lock_arms(made_, capsules_, {options_.apart_m, options_.piece_rad});
    add_times();
    return std::move(made_);
  }

 private:
  result::Result<void> find_limits() {
    motion::JointLimits limits = options_.limits;
    limits.velocity.resize(7, std::numeric_limits<double>::infinity());
    for (const scene::ArmModel& arm : cell_.arms)
      for (std::size_t j = 0; j < 7; ++j)
        limits.velocity[j] = std::min(
            limits.velocity[j],
            options_.velocity_share * cell_.robot.coordinates[index(arm.coordinates[j])].velocity_per_s);
    made_.stop = motion::stop_limits(limits, options_.stop_acceleration, options_.stop_jerk);
    made_.limits = limits;
    if (auto good = motion::check_limits(limits, 7); !good) return wrong("G0203", "limits", good.error());
    if (auto good = motion::override_rates(limits, made_.stop); !good)
      return wrong("G0203", "limits", good.error());
    return {};
  }

  static tl::unexpected<result::Diagnostics> wrong(const char* code, const std::string& what,
                                                   const result::Diagnostics& why) {
    return result::fail(code, {},
                        what + ": " + (why.empty() ? "" : why.front().code + " " + why.front().message));
  }

  std::string text(std::size_t action) const {
    return "action " + std::to_string(action + 1) + ", " + text_of(cell_, plan_.actions[action].what);
  }

  result::Result<void> add_action(std::size_t number) {
    const scene::PlannedAction& action = plan_.actions[number];
    const std::size_t arm = index(action.what.arm);
    scene::ArmState& at = state_.arms[arm];
    const auto refuse = [&](const char* why) { return result::fail("G0202", {}, text(number) + ": " + why); };
    if (action.what.kind == scene::ActionKind::Pick &&
        (at.holds >= 0 || state_.things[index(action.what.thing)].holder >= 0))
      return refuse("somebody holds something");
    if (action.what.kind == scene::ActionKind::Place && at.holds != action.what.thing)
      return refuse("the arm does not hold it");
    for (const scene::Motion& each : action.motions) {
      if (each.path.size() < 2 || each.path.front().size() != 7) return refuse("no motion");
      for (std::size_t j = 0; j < 7; ++j)
        if (!(std::abs(each.path.front()[j] - at.at[j]) <= kSamePlace_rad))
          return refuse("a motion does not begin where the arm is");
      if (at.holds < 0 && each.half_open_m != opening_m_[arm])
        add_still(arm, StepKind::Fingers, number, -1, each.half_open_m, options_.fingers_s);
      opening_m_[arm] = at.half_open_m = each.half_open_m;
      if (auto done = add_motion(number, arm, each); !done) return result::forward(done);
    }
    if (action.what.kind != scene::ActionKind::MoveAway) change_hands(number, arm);
    return {};
  }

  void add_still(std::size_t arm, StepKind kind, std::size_t action, int thing, double half_open_m,
                 double duration_s) {
    ScheduledStep step;
    step.kind = kind;
    step.action = action;
    step.thing = thing;
    step.half_open_m = half_open_m;
    step.duration_s = duration_s;
    made_.arms[arm].steps.push_back(std::move(step));
    capsules_[arm].push_back({});
  }

  void change_hands(std::size_t number, std::size_t arm) {
    const scene::PlannedAction& action = plan_.actions[number];
    scene::ArmState& at = state_.arms[arm];
    scene::ThingState& thing = state_.things[index(action.what.thing)];
    if (action.what.kind == scene::ActionKind::Pick) {
      at.holds = action.what.thing;
      at.half_open_m = cell_.grip_m(action.what.thing);
      thing.holder = static_cast<int>(arm);
      thing.hand_rad = action.hand_rad;
      add_still(arm, StepKind::Grip, number, action.what.thing, at.half_open_m, options_.grip_s);
      made_.arms[arm].steps.back().held = held_by(arm);
    } else {
      at.holds = -1;
      at.half_open_m = cell_.open_m(action.what.thing);
      thing.holder = -1;
      thing.pose = action.pose;
      add_still(arm, StepKind::Release, number, action.what.thing, at.half_open_m, options_.release_s);
    }
    opening_m_[arm] = at.half_open_m;
  }

  result::Result<void> add_motion(std::size_t number, std::size_t arm, const scene::Motion& planned) {
    scene::ArmState& at = state_.arms[arm];
    motion::JointPath points = without_repetitions(planned.path);
    if (points.size() < 2) return {};
    const scene::Surroundings around = surroundings(cell_, state_, kHeldShrunk_m);
    const auto exact = motion::ExactChecker::make(cell_.robot, cell_.bodies, &cell_.semantics, around.world,
                                                  cell_.arms[arm].coordinates, values_of(cell_, state_),
                                                  &cell_.spheres, around.held);
    if (!exact) return wrong("G0201", text(number), exact.error());
    ArmCapsules capsules = with_held(bare_[arm], cell_, state_, arm);
    const std::vector<Capsule> rest = others_at(bare_, cell_, state_, arm);
    if (planned.phase == scene::Phase::Transfer && !rest.empty())
      points =
          kept_clear(cell_, state_, arm, capsules, rest, *exact, points, {options_.clear_m, options_.seed});
    auto timed = time(points, planned.phase, cell_.arms[arm].chain, *exact);
    if (!timed) return wrong("G0201", text(number) + ", " + name_of(planned.phase), timed.error());
    if (auto slower = slow_down(*timed, capsules, rest); !slower)
      return wrong("G0201", text(number) + ", " + name_of(planned.phase), slower.error());
    ScheduledStep step;
    step.kind = kind_of(planned.phase, at.holds >= 0);
    step.action = number;
    step.thing = at.holds;
    step.half_open_m = planned.half_open_m;
    step.duration_s = timed->duration_s();
    step.motion = *std::move(timed);
    capsules_[arm].push_back(std::move(capsules));
    std::copy(points.back().begin(), points.back().end(), at.at.begin());
    made_.arms[arm].steps.push_back(std::move(step));
    return {};
  }

  result::Result<TimedMotion> time(const motion::JointPath& planned, scene::Phase phase,
                                   const motion::Chain& chain, const motion::ExactChecker& exact) const {
    const bool line = phase != scene::Phase::Transfer;
    motion::JointPath points = planned;
    if (line) {
      points = straightened(chain, planned, 0.5 * options_.line_m);
      if (!all_free(exact, points)) points = planned;
    }
    const motion::BlendCheck check = [&](const motion::JointPath& chords) {
      return !(line && off_line_m(chain, chords.front(), chords.back()) > options_.line_m) &&
             all_free(exact, chords);
    };
    motion::BlendOptions how;
    how.tolerance = line ? kLineBlend_rad : options_.blend_rad;
    how.chords = line ? 6 : 12;
    auto path = motion::blend(points, how, check);
    if (!path) return result::forward(path);
    auto made = with_law(*std::move(path), made_.limits);
    if (!made || made->table.rows() <= options_.most_rows) return made;
    return with_law(motion::BlendedPath(points, std::vector<double>(points.size(), 0.0)), made_.limits);
  }

  result::Result<TimedMotion> with_law(motion::BlendedPath path, const motion::JointLimits& limits) const {
    auto law = motion::plan_timing(path, limits);
    if (!law) return result::forward(law);
    auto table = motion::motion_table(path, *law, made_.limits, made_.stop,
                                      {.joints = 7, .way_points = 1000, .rows = 100'000});
    if (!table) return result::forward(table);
    return TimedMotion{std::move(path), *std::move(law), *std::move(table)};
  }

  static bool all_free(const motion::ExactChecker& exact, const motion::JointPath& path) {
    for (std::size_t k = 1; k < path.size(); ++k)
      if (exact.check_motion(path[k - 1], path[k]).kind != motion::MotionVerdict::Kind::Free) return false;
    return true;
  }

  std::optional<Capsule> held_by(std::size_t arm) const {
    const int thing = state_.arms[arm].holds;
    if (thing < 0) return std::nullopt;
    return held_capsule(cell_, arm, index(thing), state_.things[index(thing)].hand_rad);
  }

  // As fast as limits allow, or slower where the interlock would take it for an accident.
  result::Result<void> slow_down(TimedMotion& timed, const ArmCapsules& bodies,
                                 const std::vector<Capsule>& rest) {
    if (rest.empty()) return {};
    double room = room_of(bodies, timed.path, timed.law, made_.stop, rest);
    // No motion leaves more than there is where it begins and ends.
    const motion::JointPath& points = timed.path.points();
    const double ends = std::min(distance_of(capsules_at(bodies, points.front()), rest),
                                 distance_of(capsules_at(bodies, points.back()), rest));
    for (const double share : {0.6, 0.35}) {
      if (room >= std::min(options_.room_m, ends - 2.0 * kWorthIt_m)) break;
      auto slower = with_law(timed.path, motion::scaled(made_.limits, share, share, share));
      if (!slower) return result::forward(slower);
      const double more = room_of(bodies, slower->path, slower->law, made_.stop, rest);
      if (more < room + kWorthIt_m || slower->table.rows() > options_.most_rows) break;
      timed = *std::move(slower);
      room = more;
    }
    made_.nearest_m = std::min(made_.nearest_m, room);
    return {};
  }

  void add_times() {
    Replay replay(made_);
    const std::vector<double> rates(made_.arms.size(), 1.0);
    std::vector<std::size_t> at(made_.arms.size(), 0);
    double now_s = 0.0;
    while (!replay.done() && !replay.stuck()) {
      replay.advance(kPlannedStep_s, rates);
      now_s += kPlannedStep_s;
      for (std::size_t arm = 0; arm < at.size(); ++arm)
        for (; at[arm] < replay.step(arm); ++at[arm]) made_.arms[arm].steps[at[arm]].finish_s = now_s;
    }
    made_.makespan_s = now_s;
    for (ArmSchedule& arm : made_.arms)
      for (ScheduledStep& each : arm.steps) {
        // Without what it had to wait for at its beginning.
        each.start_s = std::max(0.0, each.finish_s - each.duration_s);
        made_.sequential_s += each.duration_s;
      }
  }

  const scene::RobotCell& cell_;
  scene::GeometricState state_;
  const scene::TampPlan& plan_;
  const ScheduleOptions& options_;
  std::vector<ArmCapsules> bare_;  // of each arm, empty
  std::vector<double> opening_m_;  // of each arm's fingers; below zero: unknown
  StepCapsules capsules_;
  CellSchedule made_;
};

}  // namespace

result::Result<CellSchedule> schedule_plan(const scene::RobotCell& cell, const scene::GeometricState& start,
                                           const scene::TampPlan& plan, const ScheduleOptions& options) {
  return Scheduler(cell, start, plan, options).run();
}

}  // namespace stepwright::tamp::schedule
