#include "tests/bench/ltl/plan_check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "supervisor/geometry/box.h"

namespace stepwright::bench {

namespace {

using geometry::Point;
using ltl::Label;
using ltl::Operator;

constexpr double kStep_s = 0.001;
constexpr int kLookEvery = 5;  // steps, at walls
constexpr int kSamples = 8;    // of a step's way: of 2 mm at most
constexpr double kTouch_m = 1e-6;

struct Outline {
  std::vector<Point> ring;
  geometry::Box bounds;

  explicit Outline(const ltl::Area& area) : ring(area.ring), bounds(geometry::bounds_of(area.ring)) {}
  // By the angle that the outline turns around the point.
  bool holds(Point at) const {
    if (at.x_m < bounds.low.x_m || at.x_m > bounds.high.x_m || at.y_m < bounds.low.y_m ||
        at.y_m > bounds.high.y_m)
      return false;
    double turned = 0.0;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point a = ring[k] - at, b = ring[(k + 1) % ring.size()] - at;
      turned += std::atan2(cross(a, b), dot(a, b));
    }
    return std::abs(turned) > 3.0;
  }
};

using Corners = std::array<Point, 4>;

// Whether both convex shapes, given by their corners in one order, share more than their outlines.
template <typename A, typename B>
bool share(const A& a, const B& b) {
  const auto parted = [](const auto& one, const auto& other) {
    for (std::size_t k = 0; k < one.size(); ++k) {
      const Point from = one[k], way = one[(k + 1) % one.size()] - from;
      const double size = std::hypot(way.x_m, way.y_m);
      double least = 1e300, most = -1e300, own = 0.0;
      for (const Point each : other) {
        const double off = cross(way, each - from) / size;
        least = std::min(least, off);
        most = std::max(most, off);
      }
      for (const Point each : one) {
        const double off = cross(way, each - from) / size;
        if (std::abs(off) > std::abs(own)) own = off;
      }
      if (own >= 0.0 ? most <= kTouch_m || least >= own - kTouch_m
                     : least >= -kTouch_m || most <= own + kTouch_m)
        return true;
    }
    return false;
  };
  return !parted(a, b) && !parted(b, a);
}

class Replay {
 public:
  Replay(const ltl::Problem& problem, PlanCheck& check)
      : model_(problem.train), border_(problem.floor.border), check_(check) {
    for (const ltl::Area& each : problem.floor.obstacles) obstacles_.emplace_back(each);
    for (const ltl::Area& each : problem.floor.propositions) places_.emplace_back(each);
  }

  void drive(const ltl::TrainPlan& plan) {
    state_ = plan.start;
    read({state_[0], state_[1]});
    look();
    for (const ltl::TrainPiece& piece : plan.pieces) {
      for (double left_s = piece.duration_s; left_s > 1e-12; left_s -= kStep_s) {
        const Point before{state_[0], state_[1]};
        step(piece.control, std::min(left_s, kStep_s));
        const Point after{state_[0], state_[1]};
        check_.length_m += geometry::distance(before, after);
        for (int n = 1; n <= kSamples; ++n)
          read(before + (static_cast<double>(n) / kSamples) * (after - before));
        if (++steps_ % kLookEvery == 0) look();
      }
    }
    look();
  }

 private:
  using State = ltl::TrainState;

  // S. M. LaValle 2006, section 13.1.2.4, or the paper's last factor.
  State change(const State& at, const ltl::TrainControl& control) const {
    State rate{};
    rate[0] = at[3] * std::cos(at[2]);
    rate[1] = at[3] * std::sin(at[2]);
    rate[2] = at[3] / model_.wheelbase_m * std::tan(at[4]);
    rate[3] = control.acceleration_m_s2;
    rate[4] = control.lock_rate_rad_s;
    double pull = at[3];
    for (std::size_t i = 0; i < model_.trailers; ++i) {
      const double front = i == 0 ? at[2] : at[4 + i], own = at[5 + i];
      const bool printed = model_.reading == ltl::HitchReading::Printed;
      rate[5 + i] =
          pull / model_.hitch_m * (printed ? std::sin(front) - std::sin(own) : std::sin(front - own));
      pull *= std::cos(front - own);
    }
    return rate;
  }

  void step(const ltl::TrainControl& control, double h) {
    const auto moved = [&](const State& rate, double share) {
      State to = state_;
      for (std::size_t k = 0; k < to.size(); ++k) to[k] += share * h * rate[k];
      return to;
    };
    const State a = change(state_, control), b = change(moved(a, 0.5), control);
    const State c = change(moved(b, 0.5), control), d = change(moved(c, 1.0), control);
    for (std::size_t k = 0; k < state_.size(); ++k)
      state_[k] += h / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]);
  }

  void read(Point at) {
    Label label = 0;
    for (std::size_t k = 0; k < places_.size(); ++k)
      if (places_[k].holds(at)) label |= Label{1} << k;
    if (check_.word.empty() || check_.word.back() != label) check_.word.push_back(label);
  }

  void look() {
    std::vector<Corners> links;
    Point middle{state_[0], state_[1]};
    for (std::size_t link = 0; link < model_.links(); ++link) {
      const double heading = link == 0 ? state_[2] : state_[4 + link];
      const Point ahead{std::cos(heading), std::sin(heading)}, left{-ahead.y_m, ahead.x_m};
      if (link > 0) middle = middle - model_.spacing_m * ahead;
      const Point a = 0.5 * model_.length_m * ahead, b = 0.5 * model_.width_m * left;
      links.push_back({middle + a + b, middle - a + b, middle - a - b, middle + a - b});
      if (!border_.holds(middle) || meets(border_, links.back())) check_.clear = false;
      for (const Outline& each : obstacles_)
        if (meets(each, links.back()) || each.holds(middle)) check_.clear = false;
    }
    for (std::size_t i = 0; i < links.size(); ++i)
      for (std::size_t k = i + 2; k < links.size(); ++k)
        if (share(links[i], links[k])) check_.clear = false;
  }

  // Side by side, each as a shape of two corners.
  static bool meets(const Outline& outline, const Corners& box) {
    const geometry::Box bounds = geometry::bounds_of(box);
    const auto apart = [&](const geometry::Box& other) {
      return other.low.x_m > bounds.high.x_m || other.high.x_m < bounds.low.x_m ||
             other.low.y_m > bounds.high.y_m || other.high.y_m < bounds.low.y_m;
    };
    if (apart(outline.bounds)) return false;
    for (std::size_t k = 0; k < outline.ring.size(); ++k) {
      const std::array<Point, 2> side = {outline.ring[k], outline.ring[(k + 1) % outline.ring.size()]};
      if (apart(geometry::bounds_of(side)) || !enters(box, side[0], side[1])) continue;
      return true;
    }
    return false;
  }

  // Halves the side until a part of it is inside of the box or beyond one of its sides as a whole.
  static bool enters(const Corners& box, Point from, Point to) {
    const auto depth = [&](Point at) {
      double least = 1e300;
      for (std::size_t k = 0; k < 4; ++k) {
        const Point way = box[(k + 1) % 4] - box[k];
        least = std::min(least, cross(way, at - box[k]) / std::hypot(way.x_m, way.y_m));
      }
      return least;
    };
    const Point middle = 0.5 * (from + to);
    const double half_m = 0.5 * geometry::distance(from, to), deep_m = depth(middle);
    if (deep_m > kTouch_m) return true;
    // No point of it is deeper than that.
    if (deep_m + half_m <= kTouch_m || half_m < 1e-7) return false;
    return enters(box, from, middle) || enters(box, middle, to);
  }

  const ltl::TrainModel& model_;
  Outline border_;
  std::vector<Outline> obstacles_;
  std::vector<Outline> places_;
  PlanCheck& check_;
  State state_{};
  std::size_t steps_ = 0;
};

}  // namespace

bool holds_on(const ltl::Formula& formula, const std::vector<Label>& word) {
  const auto& nodes = formula.tree.nodes;
  const std::size_t size = word.size();
  std::vector<std::vector<bool>> holds(nodes.size(), std::vector<bool>(size + 1, false));
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const auto& children = nodes[n].children;
    for (std::size_t i = size; i-- > 0;) {
      const auto child = [&](std::size_t k, std::size_t at) { return bool{holds[children[k]][at]}; };
      const auto any = [&](auto&& test) { return std::ranges::any_of(children, test); };
      bool value = false;
      switch (nodes[n].op) {
        case Operator::True:
          value = true;
          break;
        case Operator::Name:
          value = (word[i] >> nodes[n].proposition & 1) != 0;
          break;
        case Operator::Not:
          value = !child(0, i);
          break;
        case Operator::And:
          value = !any([&](ltl::SyntaxId each) { return !holds[each][i]; });
          break;
        case Operator::Or:
          value = any([&](ltl::SyntaxId each) { return bool{holds[each][i]}; });
          break;
        case Operator::Next:
          value = child(0, i + 1);
          break;
        case Operator::Eventually:
          value = child(0, i) || holds[n][i + 1];
          break;
        case Operator::Until:
          value = child(1, i) || (child(0, i) && holds[n][i + 1]);
          break;
        default:
          break;
      }
      holds[n][i] = value;
    }
  }
  return size > 0 && holds[formula.tree.root][0];
}

PlanCheck check_plan(const ltl::Problem& problem, const ltl::Formula& formula, const ltl::TrainPlan& plan) {
  PlanCheck check;
  Replay(problem, check).drive(plan);
  check.word_holds = holds_on(formula, check.word);
  return check;
}

}  // namespace stepwright::bench
