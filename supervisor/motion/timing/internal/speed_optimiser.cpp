#include "supervisor/motion/timing/internal/speed_optimiser.h"

#include <algorithm>
#include <cmath>

#include "supervisor/motion/timing/internal/roots.h"

namespace stepwright::motion::internal {

SpeedOptimiser::SpeedOptimiser(const SpeedGrid& grid) : intervals_(grid.size()) {
  make_stations(grid);
  for (auto* each : {&step_, &rhs_, &diagonal_, &beside_, &second_}) each->assign(intervals_ + 2, 0.0);
  // A hill, whose slopes are those of a start and an end.
  unknowns_.assign(intervals_, 0.0);
  const double begin = grid.front().begin, whole = grid.back().end - begin;
  for (std::size_t k = 1; k + 1 < intervals_; ++k) {
    const double x = (0.5 * (grid[k].begin + grid[k].end) - begin) / whole;
    unknowns_[k] = x * (1.0 - x);
  }
  start();
}

void SpeedOptimiser::make_stations(const SpeedGrid& grid) {
  most_.assign(intervals_, 0.0);
  // Of the place between interval k - 1 and k: from the unknowns k - 1 and k.
  struct Node {
    double b_before = 0.0, b_after = 0.0, a_before = 0.0, a_after = 0.0, weight = 0.0;
  };
  const auto node = [&](std::size_t k) {
    const double before = grid[k - 1].length(), after = grid[k].length();
    Node made;
    if (k == 1) {  // b = (3/2) s a after a constant jerk from rest
      made.a_after = 1.0 / (1.5 * before + after);
      made.b_after = 1.5 * before * made.a_after;
      made.weight = 3.0 * before + 0.5 * after;
    } else if (k + 1 == intervals_) {
      made.a_before = -1.0 / (1.5 * after + before);
      made.b_before = -1.5 * after * made.a_before;
      made.weight = 3.0 * after + 0.5 * before;
    } else {
      made.a_after = 1.0 / (before + after);
      made.a_before = -made.a_after;
      made.b_before = after * made.a_after;
      made.b_after = before * made.a_after;
      made.weight = 0.5 * (before + after);
    }
    return made;
  };
  for (std::size_t k = 1; k + 1 < intervals_; ++k) {
    const Node left = node(k), right = node(k + 1);
    const double length = grid[k].length();
    const Three g{-left.a_before / length, (right.a_before - left.a_after) / length, right.a_after / length};
    stations_.push_back({k - 1,
                         {left.b_before, left.b_after, 0.0},
                         {left.a_before, left.a_after, 0.0},
                         g,
                         left.weight,
                         &grid[k].left,
                         length,
                         0.5 * (grid[k].left.most_b + grid[k].right.most_b)});
    stations_.push_back({k - 1,
                         {0.0, right.b_before, right.b_after},
                         {0.0, right.a_before, right.a_after},
                         g,
                         k + 2 == intervals_ ? right.weight : 0.0,
                         &grid[k].right,
                         0.0,
                         0.0});
    most_[k] = stations_[stations_.size() - 2].most_middle;
  }
}

double SpeedOptimiser::of(const Three& parts, std::size_t first, const std::vector<double>& unknowns) const {
  return parts[0] * unknowns[first] + parts[1] * unknowns[first + 1] + parts[2] * unknowns[first + 2];
}

template <typename Each>
void SpeedOptimiser::constraints(const Station& station, const std::vector<double>& unknowns,
                                 Each&& each) const {
  const double b = of(station.b, station.first, unknowns), a = of(station.a, station.first, unknowns),
               g = of(station.g, station.first, unknowns);
  if (station.length > 0.0) {
    const double share = 1.0 / station.most_middle, middle = (b + station.length * a) * share;
    each(middle, share, station.length * share, 0.0, false);
    each(1.0 - middle, -share, -station.length * share, 0.0, false);
  }
  if (station.weight > 0.0) {
    each(1.0 - b / station.limits->most_b, -1.0 / station.limits->most_b, 0.0, 0.0, false);
    for (const LimitRow& row : station.limits->acceleration) {
      const double used = row.second * b + row.first * a;
      each(1.0 - used, -row.second, -row.first, 0.0, false);
      each(1.0 + used, row.second, row.first, 0.0, false);
    }
  }
  const double root = 1.0 / std::sqrt(b), slope = -0.5 * root / b;
  for (const LimitRow& row : station.limits->jerk) {
    const double by_a = 3.0 * row.second, used = row.third * b + by_a * a + row.first * g;
    each(root - used, slope - row.third, -by_a, -row.first, true);
    each(root + used, slope + row.third, by_a, row.first, true);
  }
}

// Limits are kept once all of b is small enough: velocities grow with its root, accelerations with b, jerks
// with b^(3/2).
void SpeedOptimiser::start() {
  double most = 0.0;
  std::size_t count = 0;
  for (const Station& station : stations_) {
    const double b = of(station.b, station.first, unknowns_), a = of(station.a, station.first, unknowns_),
                 g = of(station.g, station.first, unknowns_);
    most = std::max(most, b / station.limits->most_b);
    if (station.length > 0.0) most = std::max(most, (b + station.length * a) / station.most_middle);
    for (const LimitRow& row : station.limits->acceleration)
      most = std::max(most, std::abs(row.second * b + row.first * a));
    for (const LimitRow& row : station.limits->jerk) {
      const double root =
          cube_root(std::sqrt(b) * std::abs(row.third * b + 3.0 * row.second * a + row.first * g));
      most = std::max(most, root * root);
    }
    count += (station.length > 0.0 ? 2 : 0) +
             (station.weight > 0.0 ? 1 + 2 * station.limits->acceleration.size() : 0) +
             2 * station.limits->jerk.size();
  }
  for (double& each : unknowns_) each *= 0.5 / most;
  constraints_.assign(count, {});
  excesses_.assign(stations_.size(), {});
  const double mu = duration() / static_cast<double>(count);
  std::size_t index = 0;
  for (std::size_t k = 0; k < stations_.size(); ++k) {
    const Station& station = stations_[k];
    Excess& excess = excesses_[k];
    if (station.limits->price > 0.0) {
      excess.value = 0.5 / std::sqrt(of(station.b, station.first, unknowns_));
      excess.z = mu / excess.value;
    }
    constraints(station, unknowns_, [&](double f, double, double, double, bool jerk) {
      constraints_[index++].z = mu / (jerk ? f + excess.value : f);
    });
  }
}

double SpeedOptimiser::duration() const {
  double sum = 0.0;
  for (std::size_t k = 0; k < stations_.size(); ++k) {
    const Station& station = stations_[k];
    if (station.weight > 0.0) sum += station.weight / std::sqrt(of(station.b, station.first, unknowns_));
    if (!excesses_.empty()) sum += station.limits->price * excesses_[k].value;
  }
  return sum;
}

double SpeedOptimiser::complementarity() const {
  double sum = 0.0;
  std::size_t index = 0;
  for (std::size_t k = 0; k < stations_.size(); ++k) {
    const Excess& excess = excesses_[k];
    sum += excess.value * excess.z;
    constraints(stations_[k], unknowns_, [&](double f, double, double, double, bool jerk) {
      sum += (jerk ? f + excess.value : f) * constraints_[index++].z;
    });
  }
  return sum;
}

void SpeedOptimiser::assemble(double mu) {
  for (auto* each : {&rhs_, &diagonal_, &beside_, &second_}) std::fill(each->begin(), each->end(), 0.0);
  std::size_t index = 0;
  for (std::size_t k = 0; k < stations_.size(); ++k) {
    const Station& station = stations_[k];
    Excess& excess = excesses_[k];
    excess.diagonal = excess.gradient = 0.0;
    excess.h = {};
    Local local;
    if (station.weight > 0.0) {
      const double b = of(station.b, station.first, unknowns_), root = 1.0 / std::sqrt(b);
      local.gradient[0] = -0.5 * station.weight * root / b;
      local.h[0] = 0.75 * station.weight * root / (b * b);
    }
    constraints(station, unknowns_, [&](double f, double by_b, double by_a, double by_g, bool jerk) {
      Constraint& each = constraints_[index++];
      constexpr double kLeast = 1e-14;
      each.f = std::max(jerk ? f + excess.value : f, kLeast);
      const double inverse = 1.0 / each.f, pull = mu * inverse, stiffness = each.z * inverse;
      local.gradient[0] -= pull * by_b;
      local.gradient[1] -= pull * by_a;
      local.gradient[2] -= pull * by_g;
      const double along_b = stiffness * by_b, along_a = stiffness * by_a;
      local.h[0] += along_b * by_b;
      local.h[1] += along_b * by_a;
      local.h[2] += along_b * by_g;
      local.h[3] += along_a * by_a;
      local.h[4] += along_a * by_g;
      local.h[5] += stiffness * by_g * by_g;
      if (!jerk) return;
      excess.diagonal += stiffness;
      excess.gradient -= pull;
      excess.h[0] += along_b;
      excess.h[1] += along_a;
      excess.h[2] += stiffness * by_g;
    });
    if (station.limits->price > 0.0) eliminate(excess, mu, station.limits->price, local);
    add(station, local);
  }
}

// The excess is an unknown of one station only.
void SpeedOptimiser::eliminate(Excess& excess, double mu, double price, Local& local) {
  excess.diagonal += excess.z / excess.value;
  excess.gradient += price - mu / excess.value;
  const Three over{excess.h[0] / excess.diagonal, excess.h[1] / excess.diagonal,
                   excess.h[2] / excess.diagonal};
  for (std::size_t k = 0; k < 3; ++k) local.gradient[k] -= over[k] * excess.gradient;
  local.h[0] -= over[0] * excess.h[0];
  local.h[1] -= over[0] * excess.h[1];
  local.h[2] -= over[0] * excess.h[2];
  local.h[3] -= over[1] * excess.h[1];
  local.h[4] -= over[1] * excess.h[2];
  local.h[5] -= over[2] * excess.h[2];
}

void SpeedOptimiser::add(const Station& station, const Local& local) {
  const auto& h = local.h;
  const std::size_t first = station.first;
  Three by_b, by_a, by_g;  // rows of the second derivatives times what b, a, g are made of
  for (std::size_t k = 0; k < 3; ++k) {
    rhs_[first + k] -= local.gradient[0] * station.b[k] + local.gradient[1] * station.a[k] +
                       local.gradient[2] * station.g[k];
    by_b[k] = h[0] * station.b[k] + h[1] * station.a[k] + h[2] * station.g[k];
    by_a[k] = h[1] * station.b[k] + h[3] * station.a[k] + h[4] * station.g[k];
    by_g[k] = h[2] * station.b[k] + h[4] * station.a[k] + h[5] * station.g[k];
  }
  const auto entry = [&](std::size_t i, std::size_t k) {
    return station.b[i] * by_b[k] + station.a[i] * by_a[k] + station.g[i] * by_g[k];
  };
  for (std::size_t k = 0; k < 3; ++k) diagonal_[first + k] += entry(k, k);
  beside_[first] += entry(0, 1);
  beside_[first + 1] += entry(1, 2);
  second_[first] += entry(0, 2);
}

// L D L' with two diagonals below the first; the unknowns of the intervals at rest are none.
double SpeedOptimiser::solve_step() {
  double gain = 0.0;
  const std::size_t begin = 1, end = intervals_ - 1;
  std::vector<double>&d = diagonal_, &one = beside_, &two = second_;
  for (std::size_t k = begin; k < end; ++k) {
    if (k >= begin + 1) {
      d[k] -= one[k - 1] * one[k - 1] * d[k - 1];
      rhs_[k] -= one[k - 1] * rhs_[k - 1];
    }
    if (k >= begin + 2) {
      d[k] -= two[k - 2] * two[k - 2] * d[k - 2];
      rhs_[k] -= two[k - 2] * rhs_[k - 2];
    }
    const double carried = k >= begin + 1 ? two[k - 1] * d[k - 1] * one[k - 1] : 0.0;
    one[k] = k + 1 < end ? (one[k] - carried) / d[k] : 0.0;
    two[k] = k + 2 < end ? two[k] / d[k] : 0.0;
  }
  for (std::size_t k = end; k-- > begin;) {
    step_[k] = rhs_[k] / d[k];
    gain += rhs_[k] * step_[k];
    if (k + 1 < end) step_[k] -= one[k] * step_[k + 1];
    if (k + 2 < end) step_[k] -= two[k] * step_[k + 2];
  }
  return gain;
}

std::array<double, 2> SpeedOptimiser::step_lengths(double mu) {
  constexpr double kMost = 0.99;
  double primal = 1.0, dual = 1.0;
  std::size_t index = 0;
  for (std::size_t k = 0; k < stations_.size(); ++k) {
    const Station& station = stations_[k];
    Excess& excess = excesses_[k];
    const double b = of(station.b, station.first, unknowns_), more_b = of(station.b, station.first, step_),
                 more_a = of(station.a, station.first, step_), more_g = of(station.g, station.first, step_);
    if (more_b < 0.0) primal = std::min(primal, -0.9 * b / more_b);
    if (station.limits->price > 0.0) {
      excess.step = -(excess.gradient + excess.h[0] * more_b + excess.h[1] * more_a + excess.h[2] * more_g) /
                    excess.diagonal;
      if (-excess.step * primal > kMost * excess.value) primal = -kMost * excess.value / excess.step;
      excess.change = (mu - excess.z * excess.step) / excess.value - excess.z;
      if (-excess.change * dual > kMost * excess.z) dual = -kMost * excess.z / excess.change;
    }
    constraints(station, unknowns_, [&](double, double by_b, double by_a, double by_g, bool jerk) {
      Constraint& each = constraints_[index++];
      const double slope = by_b * more_b + by_a * more_a + by_g * more_g + (jerk ? excess.step : 0.0);
      if (slope < 0.0 && -slope * primal > kMost * each.f) primal = -kMost * each.f / slope;
      each.change = (mu - each.z * slope) / each.f - each.z;
      if (each.change < 0.0 && -each.change * dual > kMost * each.z) dual = -kMost * each.z / each.change;
    });
  }
  return {primal, dual};
}

double SpeedOptimiser::lower_bound() {
  weights_.clear();
  bool proved = true;
  std::vector<double> gradient(intervals_ + 2, 0.0);
  std::size_t index = 0;
  // Lagrange's function without excesses, whose own multipliers are what is left of their prices.
  double bound = 0.0, at_end = 0.0;  // multipliers of jerk at the end of the interval before
  for (const Station& station : stations_) {
    double sum = 0.0;
    const std::size_t first = index;
    constraints(station, unknowns_, [&](double, double, double, double, bool jerk) {
      sum += jerk ? constraints_[index].z : 0.0;
      ++index;
    });
    const double price = station.limits->price, share = price > 0.0 && sum > price ? price / sum : 1.0;
    sum *= share;
    index = first;
    Three local{};
    if (station.weight > 0.0) {
      const double b = of(station.b, station.first, unknowns_), root = std::sqrt(b);
      local[0] = -0.5 * station.weight / (b * root);
      bound += station.weight / root;
    }
    constraints(station, unknowns_, [&](double f, double by_b, double by_a, double by_g, bool jerk) {
      const double z = constraints_[index++].z * (jerk ? share : 1.0);
      local[0] -= z * by_b;
      local[1] -= z * by_a;
      local[2] -= z * by_g;
      bound -= z * f;
    });
    for (std::size_t k = 0; k < 3; ++k)
      gradient[station.first + k] +=
          local[0] * station.b[k] + local[1] * station.a[k] + local[2] * station.g[k];
    if (station.weight > 0.0) {
      constexpr double kRounding = 1.0 + 1e-9;  // of prices that sum up to the weight
      const bool begins = station.length > 0.0;
      weights_.push_back(
          {station.first + (begins ? 1 : 2), station.weight, begins ? sum : 0.0, begins ? at_end : sum});
      proved = proved && sum + at_end <= kRounding * station.weight;
      at_end = 0.0;
    } else {
      at_end = sum;
    }
  }
  if (!proved) return 0.0;
  // An unknown lies between 0 and most_.
  for (std::size_t k = 1; k + 1 < intervals_; ++k)
    bound -= std::max(gradient[k] * unknowns_[k], gradient[k] * (unknowns_[k] - most_[k]));
  return bound;
}

SpeedProfile SpeedOptimiser::solve(const OptimiserOptions& options) {
  SpeedProfile best;
  const double count = static_cast<double>(constraints_.size());
  double now = duration(), gap = now, mu = now / count;
  std::vector<double> fastest = unknowns_;
  best.duration = now;
  int steady = 0;
  while (best.steps < options.most_steps && steady < 2) {
    ++best.steps;
    assemble(mu);
    const double gain = solve_step();
    const auto [primal, dual] = step_lengths(mu);
    for (std::size_t k = 1; k + 1 < intervals_; ++k) unknowns_[k] += primal * step_[k];
    for (Constraint& each : constraints_) each.z += dual * each.change;
    for (Excess& each : excesses_) {
      each.value += primal * each.step;
      each.z += dual * each.change;
    }
    gap = complementarity();
    const double before = now, shortest = std::min(primal, dual);
    now = duration();
    if (!(now > 0.0) || !(gap > 0.0)) break;  // not a number: what was found before counts
    // Multipliers go down as fast as the steps can follow, and not far below what is still to be gained.
    if (shortest > 0.5) mu = std::max(0.15 * mu, std::min(mu, 0.5 * gain / count));
    if (shortest < 0.1) mu *= 2.0;
    if (now < best.duration) {
      best.duration = now;
      best.gap = gap;
      fastest = unknowns_;
    }
    if (gap > options.gap * now) continue;
    best.bound = std::max(best.bound, lower_bound());
    best.weights = weights_;
    if (best.bound > 0.0 && best.duration - best.bound <= options.gap * best.duration) break;
    steady = best.bound == 0.0 && std::abs(now - before) < 0.02 * options.gap * now &&
                     gap < 0.2 * options.gap * now
                 ? steady + 1
                 : 0;
  }
  unknowns_ = fastest;
  for (const Station& station : stations_) {
    if (!(station.weight > 0.0)) continue;
    best.b.push_back(of(station.b, station.first, unknowns_));
    best.a.push_back(of(station.a, station.first, unknowns_));
  }
  return best;
}

}  // namespace stepwright::motion::internal
