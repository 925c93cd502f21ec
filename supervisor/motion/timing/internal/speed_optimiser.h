#pragma once

// The fastest motion along a grid of a path within limits of velocity, acceleration and jerk.
//
// b(s) = (ds/dt)^2 is a quadratic in each interval, continuous with its slope, so a = b'/2 is linear and
// g = a' a constant; beside rest b is that of a constant jerk. Unknown is the middle control point of b in
// each interval. Limits of velocity and acceleration are linear in them. A limit of jerk, divided by sqrt(b),
// is
//
//   1 / sqrt(b) -+ (q''' b + 3 q'' a + q' g) / jerk >= 0,
//
// a convex function that is not to be negative. Its tangent is below it, so that a step along tangents cannot
// leave what is allowed (Debrouwere et al. 2013, time-optimal path following with convex-concave
// constraints). The steps are those of a primal-dual interior-point method with five diagonals.
//
// The multipliers prove how good the result is: where those of the jerk at a place sum up to no more than
// the time that the place weighs, Lagrange's function is convex, and its minimum is a lower bound of the
// duration over everything that b can be on this grid (`bound`). Where they are more, limits of jerk can be
// given a price (GridEnd::price), which is a bound on them.
//
// A class for one thread; the same result on every machine: sums in a fixed order, + - * / and sqrt.

#include <array>
#include <cstddef>
#include <vector>

#include "supervisor/motion/timing/internal/speed_grid.h"

namespace stepwright::motion::internal {

// What multipliers of jerk sum up to at a place where interval `interval` begins: its own there, and those of
// the interval before at its end. More than the place's weight in the duration spoils the proof.
struct JerkWeight {
  std::size_t interval = 0;
  double weight = 0.0, at_begin = 0.0, at_end = 0.0;
};

struct SpeedProfile {
  // At the inner ends of the grid's intervals: (ds/dt)^2 and d2s/dt2; one less than intervals.
  std::vector<double> b, a;
  double duration = 0.0;            // by the trapezoidal rule over 1 / sqrt(b), as `bound` is
  double bound = 0.0;               // no profile of this grid has a shorter one; 0 where this is not proved
  std::vector<JerkWeight> weights;  // of the last bound that was tried, one a place between intervals
  double gap = 0.0;                 // of the method: what `duration` might be above a minimum nearby
  int steps = 0;
};

struct OptimiserOptions {
  double gap = 5e-4;  // of the duration, that is good enough
  int most_steps = 120;
};

class SpeedOptimiser {
 public:
  explicit SpeedOptimiser(const SpeedGrid& grid);

  SpeedProfile solve(const OptimiserOptions& options);

 private:
  using Three = std::array<double, 3>;

  // An end of an interval: what b, a, g are made of there, from the unknowns `first`, first + 1, first + 2.
  struct Station {
    std::size_t first = 0;
    Three b{}, a{}, g{};
    double weight = 0.0;  // of 1 / sqrt(b) in the duration; 0 where the place is the other interval's, too
    const GridEnd* limits = nullptr;
    // Left ends: b + length a is the middle control point, positive and at most `most_middle`, so that b is
    // positive everywhere and within the limits of velocity.
    double length = 0.0, most_middle = 0.0;
  };
  // A constraint f >= 0 with its multiplier.
  struct Constraint {
    double f = 0.0, z = 0.0, change = 0.0;
  };
  // By how much limits of jerk are exceeded at a station that has a price for it, with its multiplier; what
  // is left of its row of the equations: h times (b, a, g) + diagonal times the step = -gradient.
  struct Excess {
    double value = 0.0, z = 0.0, step = 0.0, change = 0.0, diagonal = 0.0, gradient = 0.0;
    Three h{};
  };
  // Gradient and second derivatives in b, a, g.
  struct Local {
    Three gradient{};
    std::array<double, 6> h{};  // bb ba bg aa ag gg
  };

  void make_stations(const SpeedGrid& grid);
  void start();
  template <typename Each>
  void constraints(const Station& station, const std::vector<double>& unknowns, Each&& each) const;
  double of(const Three& parts, std::size_t first, const std::vector<double>& unknowns) const;
  double duration() const;  // with the price of what is exceeded
  double complementarity() const;
  void assemble(double mu);
  static void eliminate(Excess& excess, double mu, double price, Local& local);
  void add(const Station& station, const Local& local);
  // What the step would gain by the quadratic model, twice.
  double solve_step();
  // Lengths of the step for unknowns and multipliers.
  std::array<double, 2> step_lengths(double mu);
  double lower_bound();

  std::size_t intervals_;
  std::vector<Station> stations_;
  std::vector<double> unknowns_, step_, rhs_, diagonal_, beside_, second_;
  std::vector<Constraint> constraints_;
  std::vector<double> most_;      // of the unknowns
  std::vector<Excess> excesses_;  // one a station
  std::vector<JerkWeight> weights_;
};

}  // namespace stepwright::motion::internal
