// What stands in the way of the arms: seen before one meets it, or found where one has stopped.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "supervisor/tamp/mission/arms_mission.h"
#include "supervisor/tamp/schedule/arm_capsules.h"

namespace stepwright::tamp::mission {

using run::IncidentKind;

namespace {

constexpr double kSameObstacle_m = 0.03;  // of two reports, or of a plan and a report
// An arm that has met an obstacle is so near to what is taken to stand there: capsules are larger than the
// arm, and the obstacle than it must be.
constexpr double kMet_m = 0.03;
constexpr double kStands_rad = 5e-4;   // what encoders say of a joint that stands differs by less
constexpr int kMostBlocked = 2;        // plans around what an arm has met; then the run ends
constexpr double kBackEvery_s = 0.05;  // places of the way back
constexpr std::size_t kMostBack = 60;

bool same_place(const Seen& a, const Seen& b) {
  return std::hypot(a.pose.x_m - b.pose.x_m, a.pose.y_m - b.pose.y_m) < kSameObstacle_m;
}

std::string place_of(const Seen& seen) {
  return fmt::format("{:.2f} {:.2f} m", seen.pose.x_m, seen.pose.y_m);
}

}  // namespace

// One that two reports agree in, and the plan does not know.
std::optional<Seen> ArmsMission::new_obstacle() const {
  const auto is_at = [](const Seen& one) {
    return [&one](const Seen& each) { return each.kind == kObstacle && same_place(one, each); };
  };
  for (const Seen& each : newest_.back())
    if (each.kind == kObstacle && std::ranges::any_of(newest_.front(), is_at(each)) &&
        std::ranges::none_of(driven_->strangers, is_at(each)))
      return each;
  return std::nullopt;
}

// The obstacle that an arm touches where it stands; the nearest one.
std::optional<Seen> ArmsMission::met_by(std::size_t arm) const {
  const scene::RobotCell& cell = planning_.cell();
  const auto bodies = schedule::capsules_at(schedule::arm_capsules(cell, arm), reading_.arms[arm].joints);
  std::optional<Seen> met;
  double least_m = kMet_m;
  for (const Seen& each : sight_.strangers) {
    const double radius_m = each.kind == kObstacle ? radius_around(cell.obstacle) : 0.05;
    const double height_m = each.kind == kObstacle ? cell.obstacle.height_m : 0.12;
    schedule::Capsule body;
    body.from = {each.pose.x_m, each.pose.y_m, each.pose.z_m};
    body.to = {each.pose.x_m, each.pose.y_m, each.pose.z_m + height_m};
    body.radius_m = radius_m;
    const double far_m = schedule::distance_of(bodies, std::vector{body});
    if (far_m >= least_m) continue;
    least_m = far_m;
    met = each;
  }
  return met;
}

// After a drive's fault, with what the camera has seen since: the arm has met something that can be planned
// around, or the run ends with that fault.
bool ArmsMission::judge_fault() {
  if (!fault_) return true;
  const Surprise fault = *std::exchange(fault_, std::nullopt);
  run::Cause cause = cause_of(fault);
  const auto met = met_by(fault.fault->arm);
  if (!met) {
    note_cause(cause);
    return give_up(cause);
  }
  cause.kind = IncidentKind::Position;
  cause.devices.clear();
  cause.evidence.push_back(fault.about + " is blocked: something stands there, at " + place_of(*met));
  if (++tries_[fault.about] > kMostBlocked) {
    cause.evidence.push_back(fmt::format("that is the {}. time, and the last", tries_[fault.about]));
    return give_up(cause);
  }
  note_cause(cause);
  met_ = fault.fault->arm;
  return true;
}

// A joint that stands where it was in spite of its set points is stuck, one that has gone on is elsewhere.
run::Cause ArmsMission::cause_of(const Surprise& fault) const {
  run::Cause cause = fault.cause;
  const Fault& what = *fault.fault;
  if (what.joint == 0) return cause;
  const ArmReading& now = reading_.arms[what.arm];
  const bool stands = std::abs(now.joints[at(what.joint - 1)] - what.at_rad) < kStands_rad;
  const std::string& who = planning_.cell().arms[what.arm].name;
  cause.evidence = {
      stands ? fmt::format("joint {} of the {} arm does not move, {:.3f} rad behind its path: it is stuck",
                           what.joint, who, what.off_rad)
             : fmt::format("joint {} of the {} arm has left its path by {:.3f} rad", what.joint, who,
                           what.off_rad)};
  return cause;
}

// What is known by now of the newest incident.
void ArmsMission::note_cause(const run::Cause& cause) {
  if (!record_.incidents.empty()) {
    record_.incidents.back().kind = cause.kind;
    record_.incidents.back().evidence = cause.evidence;
  }
  if (!record_.replans.empty()) record_.replans.back().cause = run::sentence_of(cause.evidence);
}

// Back from what an arm has met, before anything else is planned: nothing, if there is no need or no way.
std::optional<PreparedArms> ArmsMission::retreat() const {
  auto prepared = planning_.retreat(
      {.arm = *met_, .state = observed_.state, .strangers = sight_.strangers, .back = way_back(*met_)});
  if (!prepared) return std::nullopt;
  return *std::move(prepared);
}

// "; obstacles are in the way, at 0.55 0.10 m"
std::string ArmsMission::obstacles() const {
  std::string text;
  for (const Seen& each : sight_.strangers)
    text += (text.empty() ? "; obstacles are in the way, at " : ", ") + place_of(each);
  return text;
}

std::vector<motion::JointPath> ArmsMission::ways_back() const {
  std::vector<motion::JointPath> all;
  for (std::size_t arm = 0; arm < reading_.arms.size(); ++arm) all.push_back(way_back(arm));
  return all;
}

// Along the motions of the plan that was driven, up to where the hand took or let go something; empty: nobody
// knows.
motion::JointPath ArmsMission::way_back(std::size_t arm) const {
  if (!driven_ || arm >= came_.size()) return {};
  const auto& steps = driven_->schedule.arms[arm].steps;
  const scene::JointValues& now = observed_.state.arms[arm].at;
  const motion::Configuration here(now.begin(), now.end());
  motion::JointPath came;
  for (auto k = static_cast<std::size_t>(std::max(0.0, came_[arm])); k < steps.size(); --k) {
    const schedule::ScheduledStep& step = steps[k];
    if (step.kind == schedule::StepKind::Grip || step.kind == schedule::StepKind::Release) break;
    if (step.motion) {
      const double share = std::min(1.0, came_[arm] - static_cast<double>(k));
      motion::Configuration place(here.size());
      for (double time_s = share * step.duration_s; time_s > -kBackEvery_s; time_s -= kBackEvery_s) {
        step.motion->path.at(step.motion->law.at(std::max(0.0, time_s)).place, place);
        came.push_back(place);
      }
    }
    if (k == 0) break;
  }
  if (came.empty()) return {};
  // Set points are ahead of the arm: it is where it comes nearest to its path. That place may be a little
  // ahead of it, where it has met something: the way back begins behind it.
  const auto nearest = std::ranges::min_element(
      came, {}, [&](const motion::Configuration& each) { return motion::joint_distance(each, here); });
  motion::JointPath back{here};
  for (auto each = std::next(nearest); each != came.end() && back.size() < kMostBack; ++each)
    if (motion::joint_distance(*each, back.back()) > 1e-3) back.push_back(*each);
  return back;
}

}  // namespace stepwright::tamp::mission
