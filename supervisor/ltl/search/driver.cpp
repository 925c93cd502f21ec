#include "supervisor/ltl/search/driver.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stepwright::ltl {

namespace {

using geometry::Point;

constexpr double kTolerance = 1e-8;
constexpr double kStep_m = 0.05;  // between two looks
constexpr double kPeriod_s = 0.1;
constexpr double kMarkEvery_m = 1.0;
constexpr double kSlowest_m_s = 0.4;
constexpr double kBackwards_rad = 1.9;         // what lies behind may be turned to on either side
constexpr double kPatience_m = 8.0;            // beyond a full circle
constexpr std::uint64_t kMostSteps = 300'000;  // of the integration, in one drive

// A point that runs ahead along the route and waits at each place that is not entered yet.
class Carrot {
 public:
  explicit Carrot(const Route& route) : route_(route) {
    for (std::size_t k = 1; k < route.size(); ++k)
      left_m_ += geometry::distance(route[k - 1].at, route[k].at);
  }

  Point at() const { return at_; }
  double left_m() const { return left_m_; }
  bool waits() const { return next_ < route_.size() && seen_ < route_[next_].through.size(); }
  bool over() const { return next_ == route_.size(); }
  std::size_t next() const { return next_; }
  std::size_t seen() const { return seen_; }

  void start() {
    at_ = route_.front().at;
    next_ = 1;
  }
  bool run(Point from, double ahead_m) {
    bool moved = false;
    // On while it is too near, or comes nearer.
    while (next_ < route_.size() &&
           (geometry::distance(from, at_) < ahead_m || dot(route_[next_].at - at_, from - at_) > 0.0)) {
      const double to_next = geometry::distance(at_, route_[next_].at);
      const double step = std::min(0.05, to_next);
      if (to_next > 1e-9) at_ = at_ + (step / to_next) * (route_[next_].at - at_);
      left_m_ -= step;
      if (to_next > 0.05) {
        moved = true;
        continue;
      }
      if (waits()) break;
      ++next_;
      seen_ = 0;
      moved = true;
    }
    return moved;
  }
  // Whether the route has this change next.
  bool expects(std::uint32_t state) {
    std::size_t seen = seen_;
    for (std::size_t k = next_; k < route_.size(); ++k, seen = 0) {
      const auto& through = route_[k].through;
      if (seen == through.size()) continue;
      const auto found = std::find(through.begin() + static_cast<std::ptrdiff_t>(seen), through.end(), state);
      if (found == through.end()) return false;
      const auto place = static_cast<std::size_t>(found - through.begin()) + 1;
      if (k == next_) {
        seen_ = place;
      } else {
        // The train was there before the carrot.
        jump(k, place);
      }
      return true;
    }
    return false;
  }

 private:
  void jump(std::size_t next, std::size_t seen) {
    for (; next_ < next; ++next_) {
      left_m_ -= geometry::distance(at_, route_[next_].at);
      at_ = route_[next_].at;
    }
    seen_ = seen;
  }

  const Route& route_;
  Point at_;
  std::size_t next_ = 1;
  std::size_t seen_ = 0;  // changes of the task on the way to the next point
  double left_m_ = 0.0;
};

TrainControl steer(const TrainModel& model, const TrainState& state, Point target, const DriveStyle& style) {
  const Point to = target - Point{state[kTrainX], state[kTrainY]};
  const double distance = std::max(0.05, std::hypot(to.x_m, to.y_m));
  // The wheels turn slowly: what the train still turns while they go back to straight counts already.
  const double lag = state[kTrainSpeed] * std::tan(state[kTrainLock]) * std::abs(state[kTrainLock]) /
                     (2.0 * model.wheelbase_m * model.most_lock_rate_rad_s);
  const double off =
      std::remainder(std::atan2(to.y_m, to.x_m) - state[kTrainHeading] - lag, 2.0 * std::numbers::pi);
  const double most = std::min(0.98 * model.most_lock_rad, std::atan(model.wheelbase_m / style.tightest_m));
  double lock = std::atan(2.0 * model.wheelbase_m * std::sin(off) / distance);
  if (std::abs(off) > 0.5 * std::numbers::pi) lock = off > 0.0 ? most : -most;
  if (std::abs(off) > kBackwards_rad && style.side != 0) lock = style.side > 0 ? most : -most;
  lock = std::clamp(lock, -most, most);
  const double change = lock - state[kTrainLock];
  const double bend = std::abs(change) + 0.7 * std::abs(state[kTrainLock]);
  const double speed = std::max(kSlowest_m_s, style.cruise_m_s / (1.0 + style.slowing * bend));
  return {std::clamp((speed - state[kTrainSpeed]) / kPeriod_s, -model.most_acceleration_m_s2,
                     model.most_acceleration_m_s2),
          std::clamp(change / kPeriod_s, -model.most_lock_rate_rad_s, model.most_lock_rate_rad_s)};
}

}  // namespace

// The link that meets a wall; the middle one where two links meet.
std::optional<std::size_t> Driver::blocked(const TrainState& state) const {
  const LinkBoxes boxes = link_boxes(model_, state);
  for (std::size_t link = 0; link < model_.links(); ++link)
    if (walls_.meets(boxes[link])) return link;
  if (meets_itself(shape_, boxes)) return model_.links() / 2;
  return std::nullopt;
}

DriveMark Driver::stand(const TrainState& state, std::uint32_t task) const {
  return {state, task, places_.label({state[kTrainX], state[kTrainY]}), 0, 0.0, 0.0};
}

Driver::Event Driver::advance(TrainMotion& motion, const TrainControl& control, double duration_s,
                              DriveMark& at, Drive& drive) {
  DriveMark next = at;
  const std::size_t pieces = drive.pieces.size();
  changes_.clear();
  TrainControl used = motion.within_limits(next.state, control);
  double left_s = duration_s, piece_s = 0.0;
  bool accepted = false;
  const auto refused = [&](Event event) {
    drive.pieces.resize(pieces);
    return event;
  };
  while (left_s > 1e-9 && !accepted) {
    const Point from{next.state[kTrainX], next.state[kTrainY]};
    const double step_s = motion.step(next.state, used, left_s);
    left_s -= step_s;
    piece_s += step_s;
    ++steps_;
    // A limit that was met is a piece's end: each piece is what its control says.
    const TrainControl held = motion.within_limits(next.state, control);
    if (held != used) {
      drive.pieces.push_back({used, piece_s});
      piece_s = 0.0;
      used = held;
    }
    const Point to{next.state[kTrainX], next.state[kTrainY]};
    if (const auto link = blocked(next.state)) {
      drive.blocked_link = *link;
      return refused(Event::Blocked);
    }
    letters_.clear();
    // On with the last label: what a step ends on is read by one of two steps, and by one only.
    next.label = places_.read(from, to, next.label, letters_);
    for (const Label letter : letters_) {
      const std::uint32_t task = states_.next(next.task, letter);
      if (task != next.task) changes_.push_back(task);
      next.task = task;
      if (states_.rejecting(task)) return refused(Event::Broken);
      if (states_.accepting(task)) {
        accepted = true;
        break;
      }
    }
    next.length_m += geometry::distance(from, to);
  }
  if (piece_s > 0.0) drive.pieces.push_back({used, piece_s});
  next.pieces = drive.pieces.size();
  at = next;
  if (accepted) return Event::Done;
  return changes_.empty() ? Event::None : Event::Changed;
}

Drive Driver::along(const Route& route, const DriveMark& from, const DriveStyle& style, const Doubt& doubt) {
  Drive drive;
  TrainMotion motion(model_, kTolerance, kStep_m);
  Carrot carrot(route);
  carrot.start();
  DriveMark at{from.state, from.task, from.label, 0, 0.0, carrot.left_m()};
  const double patience_m = kPatience_m + 2.0 * std::numbers::pi * style.tightest_m;
  double moved_at_m = 0.0;
  double marked_at_m = 0.0;
  const auto end = [&](DriveEnd how) {
    drive.end = how;
    drive.marks.push_back(at);
    return std::move(drive);
  };
  while (true) {
    const Point here{at.state[kTrainX], at.state[kTrainY]};
    if (carrot.run(here, style.lookahead_m)) moved_at_m = at.length_m;
    at.left_m = carrot.left_m() + geometry::distance(here, carrot.at());
    at.next = carrot.next();
    at.seen = carrot.seen();
    if (carrot.over()) return end(DriveEnd::Over);
    if (stop_.over()) return end(DriveEnd::Stopped);
    if (at.length_m - moved_at_m > patience_m || motion.steps() > kMostSteps) return end(DriveEnd::Stuck);
    if (at.length_m - marked_at_m >= kMarkEvery_m) {
      drive.marks.push_back(at);
      marked_at_m = at.length_m;
      if (doubt && doubt(at)) return end(DriveEnd::Slower);
    }
    const TrainControl control = steer(model_, at.state, carrot.at(), style);
    switch (advance(motion, control, kPeriod_s, at, drive)) {
      case Event::Done:
        return end(DriveEnd::Done);
      case Event::Blocked:
        return end(DriveEnd::Blocked);
      case Event::Broken:
        return end(DriveEnd::Broken);
      case Event::Changed:
        for (const std::uint32_t change : changes_)
          if (!carrot.expects(change)) return end(DriveEnd::Astray);
        moved_at_m = at.length_m;
        break;
      case Event::None:
        break;
    }
  }
}

Drive Driver::hold(const DriveMark& from, const TrainControl& control, double duration_s) {
  Drive drive;
  TrainMotion motion(model_, kTolerance, kStep_m);
  DriveMark at{from.state, from.task, from.label, 0, 0.0, 0.0};
  for (double left_s = duration_s; left_s > 1e-6; left_s -= kPeriod_s) {
    const Event event = advance(motion, control, std::min(left_s, kPeriod_s), at, drive);
    if (event == Event::Blocked || event == Event::Broken || event == Event::Done) {
      drive.end = event == Event::Done      ? DriveEnd::Done
                  : event == Event::Blocked ? DriveEnd::Blocked
                                            : DriveEnd::Broken;
      break;
    }
  }
  drive.marks.push_back(at);
  return drive;
}

}  // namespace stepwright::ltl
