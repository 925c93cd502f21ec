#include "supervisor/tamp/schedule/arm_locks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace stepwright::tamp::schedule {

namespace {

constexpr int kMostCuts = 8;  // of a pair of pieces, until it is locked without proof

// How far a capsule is from the axis of a joint at most: a turn by an angle moves it by no more than so many
// times the angle. For each capsule, by joint.
using Levers = std::vector<std::array<double, 7>>;

double beyond(const Capsule& capsule) {
  return std::max(length(capsule.from), length(capsule.to));
}

Levers levers_of(const ArmCapsules& arm) {
  Levers levers;
  for (const Capsule& each : arm.capsules) {
    std::array<double, 7> one{};
    const auto joint = static_cast<std::size_t>(each.joint);
    for (std::size_t k = 1; k <= joint; ++k) {
      if (k == joint) {
        one[k - 1] = std::max(std::hypot(each.from.x, each.from.y), std::hypot(each.to.x, each.to.y));
        continue;
      }
      // The next joint's origin lies aside of the axis by so much, the rest may point anywhere.
      const motion::Vector3 next = arm.joints[k].position_m;
      double lever = std::hypot(next.x, next.y) + beyond(each);
      for (std::size_t m = k + 1; m < joint; ++m) lever += length(arm.joints[m].position_m);
      one[k - 1] = lever;
    }
    levers.push_back(one);
  }
  return levers;
}

// A part of a step's path and all that is there meanwhile.
struct Piece {
  double from = 0.0, to = 0.0;  // along the path
  std::vector<Capsule> at;      // in the middle of it
  std::vector<double> sweep_m;  // how far each may be from there
};

class Mover {
 public:
  Mover(const TimedMotion& motion, const ArmCapsules& arm)
      : path_(&motion.path), arm_(&arm), levers_(levers_of(arm)) {}

  Piece piece(double from, double to) const {
    motion::Configuration joints(path_->joints());
    path_->at(0.5 * (from + to), joints);
    Piece made{from, to, capsules_at(*arm_, joints), {}};
    const std::array<double, 7> most = most_turn(from, to);
    for (const std::array<double, 7>& lever : levers_) {
      double sum = 0.0;
      for (std::size_t j = 0; j < 7; ++j) sum += 0.5 * (to - from) * most[j] * lever[j];
      made.sweep_m.push_back(sum);
    }
    return made;
  }

 private:
  // Of each joint, by the length of the path. Within a blend the slope is between those before and behind it.
  std::array<double, 7> most_turn(double from, double to) const {
    std::array<double, 7> most{};
    for (const motion::PathPiece& each : path_->pieces()) {
      if (each.end < from || each.begin > to) continue;
      for (std::size_t j = 0; j < 7; ++j) {
        const double before = path_->before(each, j);
        most[j] = std::max({most[j], std::abs(before), std::abs(before + path_->turn(each, j))});
      }
    }
    return most;
  }

  const motion::BlendedPath* path_;
  const ArmCapsules* arm_;
  Levers levers_;
};

// Every pair of capsules: how far apart it is in the middle, and how much nearer it may come.
enum class Verdict : std::uint8_t { Apart, Near, Unknown };
Verdict look(const Piece& a, const Piece& b, double apart_m) {
  Verdict verdict = Verdict::Apart;
  for (std::size_t i = 0; i < a.at.size(); ++i)
    for (std::size_t j = 0; j < b.at.size(); ++j) {
      const double between_m = distance_of(a.at[i], b.at[j]);
      if (between_m < apart_m) return Verdict::Near;
      if (between_m < apart_m + a.sweep_m[i] + b.sweep_m[j]) verdict = Verdict::Unknown;
    }
  return verdict;
}

bool locked(const Mover& one, const Piece& a, const Mover& other, const Piece& b, double apart_m, int cuts) {
  const Verdict verdict = look(a, b, apart_m);
  if (verdict != Verdict::Unknown || cuts == 0) return verdict != Verdict::Apart;
  const double sweep_a = *std::ranges::max_element(a.sweep_m);
  const double sweep_b = *std::ranges::max_element(b.sweep_m);
  if (sweep_a >= sweep_b) {
    const double middle = 0.5 * (a.from + a.to);
    return locked(one, one.piece(a.from, middle), other, b, apart_m, cuts - 1) ||
           locked(one, one.piece(middle, a.to), other, b, apart_m, cuts - 1);
  }
  const double middle = 0.5 * (b.from + b.to);
  return locked(one, a, other, other.piece(b.from, middle), apart_m, cuts - 1) ||
         locked(one, a, other, other.piece(middle, b.to), apart_m, cuts - 1);
}

struct Part {
  std::size_t step = 0;
  std::size_t mover = 0;
  double from = 0.0, to = 0.0;  // of the step's time, 0 to 1
  Piece piece;
};

struct Parts {
  std::vector<Mover> movers;
  std::vector<Part> all;  // in their order
};

Parts parts_of(const ArmSchedule& arm, const std::vector<ArmCapsules>& capsules, double piece_rad) {
  Parts made;
  for (std::size_t k = 0; k < arm.steps.size(); ++k) {
    if (!arm.steps[k].motion) continue;
    const TimedMotion& motion = *arm.steps[k].motion;
    made.movers.emplace_back(motion, capsules[k]);
    const double whole_s = motion.duration_s();
    const auto count = static_cast<std::size_t>(std::ceil(motion.path.length() / piece_rad)) + 1;
    double before = 0.0;
    for (std::size_t n = 1; n <= count; ++n) {
      const double share = static_cast<double>(n) / static_cast<double>(count);
      const double here = n == count ? motion.path.length() : motion.law.at(share * whole_s).place;
      made.all.push_back({k, made.movers.size() - 1, share - 1.0 / static_cast<double>(count), share,
                          made.movers.back().piece(before, here)});
      before = here;
    }
  }
  return made;
}

// What an arm waits for, part by part of its way.
class Locker {
 public:
  Locker(const Parts& mine, const Parts& theirs, const ArmSchedule& other, std::size_t arm, double apart_m)
      : mine_(mine), theirs_(theirs), other_(other), number_(arm), apart_m_(apart_m) {}

  void lock(ArmSchedule& arm) {
    std::size_t next = 0;
    for (std::size_t k = 0; k < arm.steps.size(); ++k) {
      ScheduledStep& step = arm.steps[k];
      await(step, 0.0, handed_over(step));
      for (; next < mine_.all.size() && mine_.all[next].step == k; ++next)
        await(step, mine_.all[next].from, needed(mine_.all[next], step.action));
    }
  }

 private:
  // So far has the other arm to be, at least.
  double needed(const Part& part, std::size_t action) const {
    for (auto each = theirs_.all.rbegin(); each != theirs_.all.rend(); ++each) {
      if (other_.steps[each->step].action > action) continue;
      const double end = static_cast<double>(each->step) + each->to;
      if (end <= reached_) break;
      if (locked(mine_.movers[part.mover], part.piece, theirs_.movers[each->mover], each->piece, apart_m_,
                 kMostCuts))
        return end;
    }
    return reached_;
  }

  // A thing is not grasped before the other arm has let it go.
  double handed_over(const ScheduledStep& step) const {
    double progress = reached_;
    if (step.kind != StepKind::Grip) return progress;
    for (std::size_t k = 0; k < other_.steps.size(); ++k) {
      const ScheduledStep& each = other_.steps[k];
      if (each.kind == StepKind::Release && each.thing == step.thing && each.action < step.action)
        progress = std::max(progress, static_cast<double>(k + 1));
    }
    return progress;
  }

  void await(ScheduledStep& step, double at, double progress) {
    if (progress <= reached_) return;
    reached_ = progress;
    // Of the same place the greater one counts.
    if (!step.waits.empty() && step.waits.back().at == at) step.waits.pop_back();
    step.waits.push_back({at, number_, progress});
  }

  const Parts& mine_;
  const Parts& theirs_;
  const ArmSchedule& other_;
  std::size_t number_;
  double apart_m_;
  double reached_ = 0.0;
};

}  // namespace

void lock_arms(CellSchedule& schedule, const StepCapsules& capsules, const LockOptions& options) {
  if (schedule.arms.size() != 2) return;
  const std::array<Parts, 2> parts = {parts_of(schedule.arms[0], capsules[0], options.piece_rad),
                                      parts_of(schedule.arms[1], capsules[1], options.piece_rad)};
  for (std::size_t arm = 0; arm < 2; ++arm) {
    const std::size_t other = 1 - arm;
    Locker(parts[arm], parts[other], schedule.arms[other], other, options.apart_m).lock(schedule.arms[arm]);
  }
}

}  // namespace stepwright::tamp::schedule
