// Schedules of the paper's problems, and of two arms at one tray: what they promise when nobody is late, and
// what comes of it when arms are late at random.

#include "supervisor/tamp/schedule/schedule_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>

#include "supervisor/motion/recheck/exact_checker.h"
#include "supervisor/motion/spatial/random.h"
#include "supervisor/tamp/schedule/replay.h"
#include "tests/support/arms_program/planned_arms.h"

namespace stepwright::tamp::schedule {
namespace {

// Both arms, fingers and things where a replay has them, judged by the bodies themselves.
class Referee {
 public:
  explicit Referee(const test::PlannedArms& planned) : planned_(planned) {
    for (const scene::ArmModel& arm : planned.cell.arms) {
      coordinates_.insert(coordinates_.end(), arm.coordinates.begin(), arm.coordinates.end());
      coordinates_.push_back(arm.gripper);
    }
  }

  std::optional<motion::Contact> contact(const Replay& replay) {
    std::vector<double> values;
    for (std::size_t arm = 0; arm < planned_.cell.arms.size(); ++arm) {
      const motion::Configuration joints = replay.joints(arm);
      values.insert(values.end(), joints.begin(), joints.end());
      values.push_back(replay.half_open_m(arm));
    }
    return checker(replay).contact(values);
  }

 private:
  // For each arm how many hands' changes are behind it: that says where all things are.
  const motion::ExactChecker& checker(const Replay& replay) {
    std::vector<std::size_t> key;
    scene::GeometricState state = initial_state(planned_.cell);
    for (std::size_t arm = 0; arm < planned_.cell.arms.size(); ++arm) {
      std::size_t changes = 0;
      for (std::size_t k = 0; k < replay.step(arm); ++k) {
        const ScheduledStep& step = planned_.schedule.arms[arm].steps[k];
        if (step.kind == StepKind::Grip || step.kind == StepKind::Release) ++changes;
      }
      key.push_back(changes);
    }
    const auto found = known_.find(key);
    if (found != known_.end()) return *found->second;
    std::vector<std::size_t> left = key;
    for (const scene::PlannedAction& each : planned_.plan.actions) {
      if (each.what.kind == scene::ActionKind::MoveAway) continue;
      std::size_t& mine = left[static_cast<std::size_t>(each.what.arm)];
      if (mine == 0) continue;
      --mine;
      scene::ThingState& thing = state.things[static_cast<std::size_t>(each.what.thing)];
      thing.holder = each.what.kind == scene::ActionKind::Pick ? each.what.arm : -1;
      if (each.what.kind == scene::ActionKind::Pick) thing.hand_rad = each.hand_rad;
      if (each.what.kind == scene::ActionKind::Place) thing.pose = each.pose;
    }
    const scene::Surroundings around = surroundings(planned_.cell, state, 3e-4);
    auto made = motion::ExactChecker::make(planned_.cell.robot, planned_.cell.bodies,
                                           &planned_.cell.semantics, around.world, coordinates_,
                                           planned_.cell.rest, &planned_.cell.spheres, around.held);
    return *known_.emplace(key, std::make_unique<motion::ExactChecker>(*std::move(made))).first->second;
  }

  const test::PlannedArms& planned_;
  std::vector<int> coordinates_;
  std::map<std::vector<std::size_t>, std::unique_ptr<motion::ExactChecker>> known_;
};

// Drives through it with arms that are late at random. How often something touched.
int touches(const test::PlannedArms& planned, std::uint64_t seed, bool& finished) {
  motion::Random random(seed);
  Referee referee(planned);
  Replay replay(planned.schedule);
  std::vector<double> rates(planned.cell.arms.size(), 1.0);
  int count = 0;
  for (int k = 0; k < 4'000 && !replay.done(); ++k) {
    if (k % 8 == 0)
      for (double& each : rates) each = random.between(0.0, 1.0) < 0.4 ? 0.0 : random.between(0.1, 1.0);
    if (replay.stuck()) break;
    for (int n = 0; n < 10; ++n) replay.advance(0.01, rates);
    if (referee.contact(replay)) ++count;
  }
  finished = replay.done();
  return count;
}

TEST(SchedulePlan, WhenThePaperIsPlanned_ThenStepsFollowTheirPlanAndNobodyWaitsInACircle) {
  for (const std::string name : {"p1", "p4", "p5", "two_cups"}) {
    const test::PlannedArms& planned = test::planned_once(name);
    const CellSchedule& made = planned.schedule;
    EXPECT_GT(made.steps(), 3 * planned.plan.actions.size()) << name;
    EXPECT_LE(made.most_rows(), ScheduleOptions{}.most_rows) << name;
    EXPECT_LE(made.makespan_s, made.sequential_s + 0.1) << name;
    EXPECT_GT(made.nearest_m, 0.03) << name;
    for (std::size_t arm = 0; arm < made.arms.size(); ++arm) {
      motion::Configuration at = made.arms[arm].start;
      double progress = 0.0;
      for (std::size_t k = 0; k < made.arms[arm].steps.size(); ++k) {
        const ScheduledStep& step = made.arms[arm].steps[k];
        if (step.motion) {
          EXPECT_EQ(step.motion->path.points().front(), at) << name;
          at = step.motion->path.points().back();
          EXPECT_EQ(moves(step.kind), true);
        }
        EXPECT_GE(step.start_s, k == 0 ? 0.0 : made.arms[arm].steps[k - 1].finish_s - 0.02) << name;
        double place = -1.0;
        for (const Wait& each : step.waits) {
          EXPECT_NE(each.other, arm);
          EXPECT_GT(each.at, place);
          EXPECT_GT(each.progress, progress);
          place = each.at;
          progress = each.progress;
          // What it waits for is earlier in the plan: progress p is reached within step ceil(p) - 1.
          const auto awaited = static_cast<std::size_t>(std::ceil(each.progress) - 1.0);
          EXPECT_LT(made.arms[each.other].steps[awaited].action, step.action) << name;
        }
      }
    }
  }
}

TEST(SchedulePlan, WhenArmsAreLateAtRandom_ThenTheyWaitAndNothingTouches) {
  for (const std::string name : {"p1", "two_cups"}) {
    const test::PlannedArms& planned = test::planned_once(name);
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      bool finished = false;
      EXPECT_EQ(touches(planned, seed, finished), 0) << name << ", seed " << seed;
      EXPECT_TRUE(finished) << name << ", seed " << seed;
    }
  }
}

TEST(SchedulePlan, WhenBothArmsHaveWork_ThenTheyWorkAtTheSameTimeAndWithoutLocksTheyMeet) {
  test::PlannedArms planned = test::planned_once("two_cups");
  EXPECT_GT(planned.schedule.arms[0].steps.size(), 0u);
  EXPECT_GT(planned.schedule.arms[1].steps.size(), 0u);
  EXPECT_GT(planned.schedule.waits(), 0u);
  EXPECT_LT(planned.schedule.makespan_s, 0.9 * planned.schedule.sequential_s);
  for (ArmSchedule& arm : planned.schedule.arms)
    for (ScheduledStep& each : arm.steps) each.waits.clear();
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    bool finished = false;
    count += touches(planned, seed, finished);
  }
  EXPECT_GT(count, 0);
}

TEST(SchedulePlan, WhenMotionsAreTimed_ThenTheToolKeepsToItsLinesAndLimitsAreKept) {
  const test::PlannedArms& planned = test::planned_once("p1");
  for (std::size_t arm = 0; arm < planned.schedule.arms.size(); ++arm)
    for (const ScheduledStep& step : planned.schedule.arms[arm].steps) {
      if (!step.motion) continue;
      const motion::Chain& chain = planned.cell.arms[arm].chain;
      const bool line =
          step.kind == StepKind::Linear || step.kind == StepKind::Lift || step.kind == StepKind::Lower;
      const motion::Vector3 begin = chain.forward(step.motion->path.points().front()).position_m;
      motion::Configuration before, at(7);
      double worst_m = 0.0, fastest = 0.0;
      for (double t = 0.0; t <= step.motion->duration_s(); t += 0.01) {
        step.motion->path.at(step.motion->law.at(t).place, at);
        const motion::Vector3 place = chain.forward(at).position_m;
        worst_m = std::max(worst_m, std::hypot(place.x - begin.x, place.y - begin.y));
        for (std::size_t j = 0; j < 7 && !before.empty(); ++j)
          fastest =
              std::max(fastest, std::abs(at[j] - before[j]) / 0.01 / planned.schedule.limits.velocity[j]);
        before = at;
      }
      if (line) {
        EXPECT_LT(worst_m, 0.0015);
      }
      EXPECT_LE(fastest, 1.0 + 1e-6);
    }
}

TEST(SchedulePlan, WhenActionsDoNotBelongTogether_ThenThatIsSaid) {
  const test::PlannedArms& planned = test::planned_once("p5");
  scene::TampPlan plan = planned.plan;
  std::swap(plan.actions[0], plan.actions[1]);
  const auto swapped = schedule_plan(planned.cell, initial_state(planned.cell), plan);
  ASSERT_FALSE(swapped);
  EXPECT_EQ(swapped.error().front().code, "G0202");
  plan = planned.plan;
  plan.actions[0].motions.front().path.front()[2] += 0.1;
  const auto elsewhere = schedule_plan(planned.cell, initial_state(planned.cell), plan);
  ASSERT_FALSE(elsewhere);
  EXPECT_EQ(elsewhere.error().front().code, "G0202");
  ScheduleOptions options;
  options.limits.jerk.pop_back();
  const auto no_limits = schedule_plan(planned.cell, initial_state(planned.cell), planned.plan, options);
  ASSERT_FALSE(no_limits);
  EXPECT_EQ(no_limits.error().front().code, "G0203");
}

}  // namespace
}  // namespace stepwright::tamp::schedule
