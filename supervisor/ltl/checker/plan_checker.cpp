#include "supervisor/ltl/checker/plan_checker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "plant_models/ode/cvode_solver.h"
#include "supervisor/geometry/box.h"
#include "supervisor/ltl/checker/internal/within.h"

namespace stepwright::ltl {

namespace {

using geometry::Point;

constexpr double kTouch_m = 1e-7;
constexpr std::size_t kLooksBetween = 32;  // two looks at the time
constexpr double kLimit = 1e-6;            // of speed, steering and controls beyond theirs

// The equations once more, written as the paper has them: each trailer with the product of the cosines before
// it.
class Train : public ode::OdeSystem {
 public:
  explicit Train(const TrainModel& model) : model_(model) {}

  TrainControl control;

  std::size_t state_size() const override { return model_.states(); }
  std::size_t root_count() const override { return 0; }
  void roots(double, std::span<const double>, std::span<double>) const override {}
  void derivative(double, std::span<const double> y, std::span<double> change) const override {
    change[0] = y[3] * std::cos(y[2]);
    change[1] = y[3] * std::sin(y[2]);
    change[2] = y[3] * std::tan(y[4]) / model_.wheelbase_m;
    change[3] = control.acceleration_m_s2;
    change[4] = control.lock_rate_rad_s;
    double product = 1.0;
    for (std::size_t i = 1; i <= model_.trailers; ++i) {
      if (i > 1) product *= std::cos(angle(y, i - 2) - angle(y, i - 1));
      const double front = angle(y, i - 1), own = angle(y, i);
      const double factor =
          model_.reading == HitchReading::Pulled ? std::sin(front - own) : std::sin(front) - std::sin(own);
      change[4 + i] = y[3] / model_.hitch_m * product * factor;
    }
  }

 private:
  static double angle(std::span<const double> y, std::size_t link) { return link == 0 ? y[2] : y[4 + link]; }

  const TrainModel& model_;
};

using Corners = std::array<Point, 4>;

Corners corners_of(Point middle, double heading, double length, double width) {
  const Point ahead{0.5 * length * std::cos(heading), 0.5 * length * std::sin(heading)};
  const Point left{-0.5 * width * std::sin(heading), 0.5 * width * std::cos(heading)};
  return {middle + ahead + left, middle - ahead + left, middle - ahead - left, middle + ahead - left};
}

// Whether the side goes through the inside of the convex box: what is left of it in front of each face.
bool cuts(const Corners& box, Point from, Point to) {
  double enters = 0.0, leaves = 1.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Point face = box[(k + 1) % 4] - box[k];
    const double size = std::hypot(face.x_m, face.y_m);
    const double at_from = cross(face, from - box[k]) / size - kTouch_m;
    const double at_to = cross(face, to - box[k]) / size - kTouch_m;
    if (at_from <= 0.0 && at_to <= 0.0) return false;
    if (at_from < 0.0) enters = std::max(enters, at_from / (at_from - at_to));
    if (at_to < 0.0) leaves = std::min(leaves, at_from / (at_from - at_to));
  }
  return enters < leaves;
}

bool share(const Corners& a, const Corners& b) {
  const auto apart = [](const Corners& one, const Corners& other) {
    for (std::size_t k = 0; k < 4; ++k) {
      const Point face = one[(k + 1) % 4] - one[k];
      const double size = std::hypot(face.x_m, face.y_m);
      if (std::ranges::all_of(other, [&](Point p) { return cross(face, p - one[k]) <= kTouch_m * size; }))
        return true;
    }
    return false;
  };
  return !apart(a, b) && !apart(b, a);
}

class PlanChecker {
 public:
  PlanChecker(const Floor& floor, const TrainModel& model, const PlanCheckerOptions& options,
              PlanJudgement& judgement)
      : floor_(floor),
        model_(model),
        options_(options),
        judgement_(judgement),
        reach_m_(0.5 * std::hypot(model.length_m, model.width_m)) {
    for (const auto* obstacles : {&floor.obstacles, &floor.blocked})
      for (const Area& obstacle : *obstacles)
        obstacles_.push_back({geometry::bounds_of(obstacle.ring), &obstacle});
  }

  bool replay(const TrainPlan& plan, const TrainState& start) {
    Train train(model_);
    const std::size_t count = model_.states();
    state_.assign(plan.start.begin(), plan.start.begin() + static_cast<std::ptrdiff_t>(count));
    if (plan.start != start) return refuse("the plan begins elsewhere");
    if (!look()) return false;
    auto solver = ode::CvodeSolver::create(
        train, state_, 0.0,
        {.relative_tolerance = options_.relative_tolerance,
         .absolute_tolerance = std::vector<double>(count, options_.relative_tolerance),
         .max_order = 12});
    if (!solver) return refuse("the integration does not begin");
    double begin = 0.0;
    bool first = true;
    for (const TrainPiece& piece : plan.pieces) {
      if (!(piece.duration_s > 0.0)) return refuse("a control lasts no time");
      if (!(begin + piece.duration_s <= options_.longest_s)) return refuse("the plan lasts too long");
      if (!sound(piece.control)) return false;
      train.control = effective(piece.control);
      if (!first && !solver->restart(begin, state_)) return refuse("the integration ends");
      first = false;
      if (!follow(*solver, begin, begin + piece.duration_s)) return false;
      begin += piece.duration_s;
    }
    judgement_.duration_s = begin;
    for (std::size_t k = 0; k < count; ++k)
      judgement_.end_error = std::max(judgement_.end_error, std::abs(state_[k] - plan.end[k]));
    const bool numbers = std::ranges::all_of(plan.end, [](double value) { return std::isfinite(value); });
    if (!numbers || judgement_.end_error > options_.most_end_error) return refuse("the plan ends elsewhere");
    return true;
  }

 private:
  bool refuse(const std::string& reason) {
    if (judgement_.reason.empty()) judgement_.reason = reason;
    return false;
  }

  bool sound(const TrainControl& control) {
    const bool holds = std::abs(control.acceleration_m_s2) <= model_.most_acceleration_m_s2 + kLimit &&
                       std::abs(control.lock_rate_rad_s) <= model_.most_lock_rate_rad_s + kLimit;
    return holds || refuse("a control is beyond its limits");
  }

  // What is at its limit stays there.
  TrainControl effective(TrainControl control) const {
    if (std::abs(state_[3]) >= model_.most_speed_m_s - kLimit && state_[3] * control.acceleration_m_s2 > 0.0)
      control.acceleration_m_s2 = 0.0;
    if (std::abs(state_[4]) >= model_.most_lock_rad - kLimit && state_[4] * control.lock_rate_rad_s > 0.0)
      control.lock_rate_rad_s = 0.0;
    return control;
  }

  bool follow(ode::CvodeSolver& solver, double from, double to) {
    double seen = from;
    std::vector<double> at(state_.size());
    while (seen < to) {
      const double step = std::min(to - seen, options_.look_every_m / model_.most_speed_m_s);
      const double next = to - seen - step < 1e-9 ? to : seen + step;
      while (solver.time() < next)
        if (solver.step() != ode::StepOutcome::Stepped) return refuse("the integration ends");
      if (!solver.state_at(next, at)) return refuse("the integration ends");
      judgement_.length_m += std::hypot(at[0] - state_[0], at[1] - state_[1]);
      const Point before = place();
      state_ = at;
      seen = next;
      read_way(floor_.propositions, before, place(), judgement_.word);
      if (!look()) return false;
    }
    return true;
  }

  Point place() const { return {state_[0], state_[1]}; }
  std::string there() const {
    return " at (" + std::to_string(state_[0]) + ", " + std::to_string(state_[1]) + ")";
  }

  bool look() {
    if (++judgement_.looks % kLooksBetween == 0 && options_.stop && options_.stop())
      return refuse("there was no time to judge it");
    if (!std::ranges::all_of(state_, [](double value) { return std::isfinite(value); }))
      return refuse("a state is no number");
    if (std::abs(state_[3]) > model_.most_speed_m_s + kLimit) return refuse("too fast" + there());
    if (std::abs(state_[4]) > model_.most_lock_rad + kLimit) return refuse("steers too far" + there());
    if (judgement_.word.empty()) read_way(floor_.propositions, place(), place(), judgement_.word);
    return clear();
  }

  bool clear() {
    boxes_.clear();
    middles_.clear();
    Point middle{state_[0], state_[1]};
    for (std::size_t link = 0; link < model_.links(); ++link) {
      const double heading = link == 0 ? state_[2] : state_[4 + link];
      if (link > 0) middle = middle - model_.spacing_m * Point{std::cos(heading), std::sin(heading)};
      boxes_.push_back(corners_of(middle, heading, model_.length_m, model_.width_m));
      middles_.push_back(middle);
    }
    find_near();
    for (std::size_t link = 0; link < boxes_.size(); ++link) {
      if (!internal::within(floor_.border.ring, middles_[link]) || meets(link, floor_.border))
        return refuse("link " + std::to_string(link) + " leaves the floor" + there());
      for (const std::size_t k : near_) {
        const Obstacle& obstacle = obstacles_[k];
        if (!reaches(obstacle.box.low, obstacle.box.high, middles_[link])) continue;
        if (internal::within(obstacle.area->ring, middles_[link]) || meets(link, *obstacle.area))
          return refuse("link " + std::to_string(link) + " meets '" + obstacle.area->name + "'" + there());
      }
    }
    for (std::size_t link = 1; link < model_.links(); ++link)
      if (std::abs(std::remainder((link == 1 ? state_[2] : state_[3 + link]) - state_[4 + link],
                                  2.0 * std::numbers::pi)) > model_.most_hitch_rad + kLimit)
        return refuse("hitch " + std::to_string(link) + " folds" + there());
    for (std::size_t i = 0; i < boxes_.size(); ++i)
      for (std::size_t k = i + 2; k < boxes_.size(); ++k)
        if (may_touch(middles_[i] - middles_[k]) && share(boxes_[i], boxes_[k]))
          return refuse("links " + std::to_string(i) + " and " + std::to_string(k) + " meet" + there());
    return true;
  }

  // The obstacles whose bounds the train as a whole comes near to.
  void find_near() {
    const geometry::Box all = geometry::bounds_of(middles_);
    near_.clear();
    for (std::size_t k = 0; k < obstacles_.size(); ++k) {
      const geometry::Box& box = obstacles_[k].box;
      if (box.low.x_m <= all.high.x_m + reach_m_ && box.high.x_m >= all.low.x_m - reach_m_ &&
          box.low.y_m <= all.high.y_m + reach_m_ && box.high.y_m >= all.low.y_m - reach_m_)
        near_.push_back(k);
    }
  }

  bool may_touch(Point apart) const { return dot(apart, apart) < 4.0 * reach_m_ * reach_m_; }

  bool meets(std::size_t link, const Area& area) const {
    for (std::size_t k = 0; k < area.ring.size(); ++k) {
      const Point from = area.ring[k], to = area.ring[(k + 1) % area.ring.size()];
      if (reaches(from, to, middles_[link]) && cuts(boxes_[link], from, to)) return true;
    }
    return false;
  }

  // Whether a link whose middle is there may come into the box between two corners.
  bool reaches(Point a, Point b, Point at) const {
    return std::min(a.x_m, b.x_m) <= at.x_m + reach_m_ && std::max(a.x_m, b.x_m) >= at.x_m - reach_m_ &&
           std::min(a.y_m, b.y_m) <= at.y_m + reach_m_ && std::max(a.y_m, b.y_m) >= at.y_m - reach_m_;
  }

  const Floor& floor_;
  const TrainModel& model_;
  PlanCheckerOptions options_;
  PlanJudgement& judgement_;
  const double reach_m_;  // of a corner from a link's middle
  struct Obstacle {
    geometry::Box box;
    const Area* area;
  };
  std::vector<Obstacle> obstacles_;
  std::vector<std::size_t> near_;  // obstacles
  std::vector<double> state_;
  std::vector<Corners> boxes_;
  std::vector<Point> middles_;
};

}  // namespace

PlanJudgement judge_plan(const Floor& floor, const TrainModel& model, const TrainState& start,
                         const Formula& formula, const TrainPlan& plan, const PlanCheckerOptions& options) {
  PlanJudgement judgement;
  PlanChecker checker(floor, model, options, judgement);
  if (!checker.replay(plan, start)) return judgement;
  std::vector<Label> word = options.read;
  for (const Label label : judgement.word)
    if (word.empty() || word.back() != label) word.push_back(label);
  if (!satisfies(formula, word)) judgement.reason = "the way does not satisfy the task";
  return judgement;
}

}  // namespace stepwright::ltl
