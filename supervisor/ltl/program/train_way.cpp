#include "supervisor/ltl/program/train_way.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "supervisor/ltl/checker/plan_checker.h"
#include "supervisor/ltl/planner/plan_way.h"
#include "supervisor/ltl/train/train_motion.h"
#include "supervisor/ltl/train/walls.h"

namespace stepwright::ltl {
namespace {

using geometry::Point;
using geometry::Travel;

constexpr double kLook_s = 0.02;
constexpr double kSlow_m_s = 0.02;  // slower is at rest
constexpr double kRunOutStep_m = 0.05;
constexpr double kRest_s = 1.5;  // what it takes to come to a place of rest and to turn the wheel there

Point place_of(const TrainState& state) {
  return {state[kTrainX], state[kTrainY]};
}

geometry::Pose pose_of(const TrainState& state) {
  return {state[kTrainX], state[kTrainY], state[kTrainHeading]};
}

// The way as states in the order of its arc, cut where the car changes its direction.
class Legs {
 public:
  explicit Legs(double sample_m) : sample_m_(sample_m) {}

  void add(const TrainState& state) {
    const bool slow = std::abs(state[kTrainSpeed]) < kSlow_m_s;
    const Travel travel = state[kTrainSpeed] < 0.0 ? Travel::Reverse : Travel::Forward;
    if (leg_.empty()) return begin(state, slow ? std::nullopt : std::optional(travel));
    const double step_m = geometry::distance(place_of(state), place_of(last_));
    if (step_m < 1e-9) return;
    if (!travel_) travel_ = travel;
    if (!slow && travel != travel_) {
      end();
      begin(last_, travel);
    }
    arc_m_ += step_m;
    last_ = state;
    if (arc_m_ - leg_.back().arc_m >= sample_m_) add_pose();
  }

  std::vector<vehicle::PathLeg> take() {
    end();
    return std::move(legs_);
  }
  double arc_m() const { return arc_m_; }

 private:
  void begin(const TrainState& state, std::optional<Travel> travel) {
    last_ = state;
    travel_ = travel;
    add_pose();
  }
  void add_pose() { leg_.push_back({pose_of(last_), arc_m_, travel_.value_or(Travel::Forward)}); }
  void end() {
    if (leg_.empty()) return;
    // A last bit that is very short would have a curvature of rounding.
    const bool short_end = arc_m_ - leg_.back().arc_m < 0.25 * sample_m_;
    if (short_end && leg_.size() > 1) leg_.pop_back();
    if (arc_m_ - leg_.back().arc_m > 1e-6) add_pose();
    if (leg_.size() > 1) legs_.push_back(std::move(leg_));
    leg_ = {};
  }

  double sample_m_;
  vehicle::PathLeg leg_;
  std::optional<Travel> travel_;  // of the leg; nothing before the car moves
  std::vector<vehicle::PathLeg> legs_;
  TrainState last_{};
  double arc_m_ = 0.0;
};

std::vector<double> times_of(const std::vector<vehicle::PathSample>& samples, const TrainDrive& drive) {
  std::vector<double> times;
  double speed = 0.0;
  double time = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double way = k == 0 ? 0.0 : samples[k].arc_m - samples[k - 1].arc_m;
    if (k > 0 && way <= 0.0) {
      time += kRest_s;
      speed = 0.0;
    } else if (k > 0) {
      const double next =
          std::min(samples[k].speed_m_s, std::sqrt(speed * speed + 2.0 * drive.speed_up_m_s2 * way));
      time += 2.0 * way / std::max(0.05, speed + next);
      speed = next;
    }
    times.push_back(time);
  }
  return times;
}

// How far the train can roll on behind its plan without meeting anything.
double free_run_out_m(const Problem& problem, const TrainPlan& plan, double most_m) {
  const double speed = plan.end[kTrainSpeed];
  if (std::abs(speed) < kSlow_m_s) return 0.0;
  const Walls walls(problem.floor, problem.train);
  TrainMotion motion(problem.train, 1e-6, kRunOutStep_m);
  TrainState state = plan.end;
  double free_m = 0.0;
  while (free_m < most_m) {
    double left_s = std::min(kRunOutStep_m, most_m - free_m) / std::abs(speed);
    const double step_m = left_s * std::abs(speed);
    while (left_s > 1e-9) left_s -= motion.step(state, {}, left_s);
    const LinkBoxes boxes = link_boxes(problem.train, state);
    if (walls.meet(boxes, problem.train.links()) || meets_itself(problem.train, boxes)) break;
    free_m += step_m;
  }
  return free_m;
}

}  // namespace

TrainPlan with_run_out(const Problem& problem, const TrainPlan& plan, double run_out_m) {
  TrainPlan longer = plan;
  const double free_m = free_run_out_m(problem, plan, run_out_m);
  if (free_m <= 0.0) return longer;
  const TrainPiece roll{{}, free_m / std::abs(plan.end[kTrainSpeed])};
  TrainMotion motion(problem.train);
  for (double left_s = roll.duration_s; left_s > 1e-9;) left_s -= motion.step(longer.end, {}, left_s);
  longer.pieces.push_back(roll);
  longer.length_m += free_m;
  return longer;
}

TrainWay train_way(const Problem& problem, const TrainPlan& plan, const TrainDrive& drive) {
  TrainWay way;
  Legs legs(drive.sample_m);
  std::vector<Label> word;
  const std::vector<WayState> states = way_of(problem.train, plan, kLook_s);
  for (std::size_t k = 0; k < states.size(); ++k) {
    const Point from = place_of(states[k == 0 ? 0 : k - 1].state);
    legs.add(states[k].state);
    read_way(problem.floor.propositions, from, place_of(states[k].state), word);
    while (way.labels.size() < word.size()) way.labels.push_back({word[way.labels.size()], legs.arc_m()});
  }
  const std::vector<vehicle::PathLeg> all = legs.take();
  if (all.empty()) return way;
  way.samples = vehicle::path_samples(all, {.wheelbase_m = problem.train.wheelbase_m,
                                            .speed = {.top_speed_m_s = drive.top_speed_m_s,
                                                      .brake_m_s2 = drive.brake_m_s2,
                                                      .lateral_m_s2 = drive.lateral_m_s2,
                                                      .lock_rate_rad_s = drive.lock_rate_rad_s}});
  way.times_s = times_of(way.samples, drive);
  way.end_m = way.samples.back().arc_m;
  return way;
}

double TrainWay::time_at(double arc_m) const {
  if (samples.empty()) return 0.0;
  const auto behind = std::ranges::lower_bound(samples, arc_m, {}, &vehicle::PathSample::arc_m);
  return behind == samples.end() ? times_s.back()
                                 : times_s[static_cast<std::size_t>(behind - samples.begin())];
}

}  // namespace stepwright::ltl
