#include "tests/bench/reach/filter_domain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace stepwright::bench {
namespace {

using tamp::Action;
using tamp::ActionKind;

constexpr double kPi = std::numbers::pi;
constexpr double kTolerance = 1e-6;
constexpr int kMostRounds = 50;
// Larger than any angle of an object that is turned a few times.
constexpr double kManyTurns = 8.0 * kPi;

// The least and the largest angle from -pi to pi: the whole of it if an arc lies across the seam.
Interval hull_of(std::span<const tamp::Arc> arcs) {
  Interval hull{kPi, -kPi};
  for (const tamp::Arc arc : arcs) {
    const double low = tamp::radians_of(arc.low), high = tamp::radians_of(arc.high());
    if (arc.width == tamp::Arc::kFull || high < low) return {-kPi, kPi};
    hull.low = std::min(hull.low, low);
    hull.high = std::max(hull.high, high);
  }
  return hull;
}

// Least squares of value over x, y, z about the means; a little ridge where the data are flat.
std::array<double, 3> slopes(const std::vector<std::array<double, 4>>& data,
                             const std::array<double, 4>& mean) {
  double a[3][4] = {};
  for (const auto& row : data)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j)
        a[i][j] += (row[static_cast<std::size_t>(i)] - mean[static_cast<std::size_t>(i)]) *
                   (row[static_cast<std::size_t>(j)] - mean[static_cast<std::size_t>(j)]);
  for (int i = 0; i < 3; ++i) a[i][i] += 1e-9;
  for (int i = 0; i < 3; ++i)
    for (int k = i + 1; k < 3; ++k) {
      const double factor = a[k][i] / a[i][i];
      for (int j = i; j < 4; ++j) a[k][j] -= factor * a[i][j];
    }
  std::array<double, 3> slope{};
  for (int i = 2; i >= 0; --i) {
    double rest = a[i][3];
    for (int j = i + 1; j < 3; ++j) rest -= a[i][j] * slope[static_cast<std::size_t>(j)];
    slope[static_cast<std::size_t>(i)] = rest / a[i][i];
  }
  return slope;
}

}  // namespace

std::size_t FilterDomain::add_pose(Interval x, Interval y, Interval z, Interval angle) {
  const std::size_t column = initial_.size();
  initial_.insert(initial_.end(), {x, y, z, angle});
  return column;
}

void FilterDomain::add_equation(std::vector<std::pair<std::size_t, double>> terms, double value) {
  equations_.emplace_back(rows_.size(), value);
  rows_.push_back({std::move(terms), value});
}

FilterDomain::FilterDomain(const tamp::WorkCell& cell, std::span<const Action> sequence, int turns,
                           double epsilon)
    : epsilon_(epsilon), handled_(sequence.size()) {
  const Interval anywhere{-tamp::kFarthest_m, tamp::kFarthest_m}, any_angle{-kManyTurns, kManyTurns};
  std::vector<std::size_t> object(cell.objects.size());
  std::vector<std::size_t> tool(cell.arms.size()), grasp(cell.arms.size());
  for (std::size_t k = 0; k < cell.objects.size(); ++k) {
    const tamp::ObjectPose& start = cell.objects[k].start;
    object[k] = add_pose({start.x_m, start.x_m}, {start.y_m, start.y_m}, {start.z_m, start.z_m},
                         {start.angle_rad, start.angle_rad});
  }
  for (std::size_t k = 0; k < sequence.size(); ++k) {
    const Action& action = sequence[k];
    if (action.kind == ActionKind::MoveAway) continue;
    const std::size_t tool_before = tool[action.arm], object_before = object[action.object];
    tool[action.arm] = add_pose(anywhere, anywhere, anywhere, {-kPi, kPi});
    if (action.kind == ActionKind::Pick) {
      grasp[action.arm] = action.grasp;
    } else {
      const tamp::Region& region = cell.regions[*action.region];
      Interval angle = any_angle;
      if (action.final_angle_rad) {
        const double final_rad =
            *action.final_angle_rad + (k + 1 == sequence.size() ? 2.0 * kPi * turns : 0.0);
        angle = {final_rad, final_rad};
      }
      object[action.object] =
          add_pose({region.x_m - 0.5 * region.size_x_m, region.x_m + 0.5 * region.size_x_m},
                   {region.y_m - 0.5 * region.size_y_m, region.y_m + 0.5 * region.size_y_m},
                   {region.z_m, region.z_m}, angle);
      for (std::size_t axis = 0; axis < 4; ++axis)
        add_equation({{object[action.object] + axis, 1.0},
                      {object_before + axis, -1.0},
                      {tool[action.arm] + axis, -1.0},
                      {tool_before + axis, 1.0}},
                     0.0);
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
      add_equation({{tool[action.arm] + axis, 1.0}, {object[action.object] + axis, -1.0}},
                   axis == 2 ? cell.grasps[grasp[action.arm]].height_m : 0.0);
    handled_[k] = Handled{object[action.object], tool[action.arm], rows_.size(), cell.arms[action.arm].reach};
    const std::size_t column = tool[action.arm];
    // Factors that a plane fills: zero ones would not be stored.
    rows_.push_back({{{column, 1.0}, {column + 1, 1.0}, {column + 2, 1.0}, {column + 3, -1.0}}, 1e9});
    rows_.push_back({{{column, 1.0}, {column + 1, 1.0}, {column + 2, 1.0}, {column + 3, 1.0}}, 1e9});
  }
  program_ = std::make_unique<tamp::LinearProgram>(initial_.size(), rows_);
  for (const auto& [row, value] : equations_) program_->bound_row(row, value, value);
}

std::optional<FilterDomain::Planes> FilterDomain::planes_of(const tamp::ReachBounds& reach,
                                                            const Domain& domain, std::size_t column) {
  const tamp::ReachGrid& grid = reach.grid();
  std::array<std::int64_t, 3> first{}, last{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Interval at = domain[column + axis];
    // A point that lies where two cells meet is in one of them.
    const bool is_point = at.high - at.low < kTolerance;
    const double low = is_point ? 0.5 * (at.low + at.high) : at.low, high = is_point ? low : at.high;
    first[axis] = std::max<std::int64_t>(grid.row(axis, tamp::nanometres_of(low)), 0);
    last[axis] = std::min<std::int64_t>(grid.row(axis, tamp::nanometres_of(high)), grid.cells[axis] - 1);
  }
  std::vector<std::array<double, 4>> lows, highs;
  std::array<double, 4> low_mean{}, high_mean{};
  for (std::int64_t z = first[2]; z <= last[2]; ++z) {
    for (std::int64_t y = first[1]; y <= last[1]; ++y) {
      for (std::int64_t x = first[0]; x <= last[0]; ++x) {
        const auto arcs = reach.arcs(grid.index(x, y, z));
        if (arcs.empty()) continue;
        const Interval hull = hull_of(arcs);
        const std::array middle{tamp::metres_of(grid.span(0, x).middle_nm()),
                                tamp::metres_of(grid.span(1, y).middle_nm()),
                                tamp::metres_of(grid.span(2, z).middle_nm())};
        lows.push_back({middle[0], middle[1], middle[2], hull.low});
        highs.push_back({middle[0], middle[1], middle[2], hull.high});
        for (std::size_t k = 0; k < 4; ++k) {
          low_mean[k] += lows.back()[k];
          high_mean[k] += highs.back()[k];
        }
      }
    }
  }
  if (lows.empty()) return std::nullopt;
  for (std::size_t k = 0; k < 4; ++k) {
    low_mean[k] /= static_cast<double>(lows.size());
    high_mean[k] /= static_cast<double>(highs.size());
  }
  const auto plane = [](const std::vector<std::array<double, 4>>& data, const std::array<double, 4>& mean,
                        double side) {
    const std::array slope = slopes(data, mean);
    Plane found{slope[0], slope[1], slope[2], 0.0};
    found.at = -side * 1e9;
    for (const auto& row : data) {
      const double rest = row[3] - slope[0] * row[0] - slope[1] * row[1] - slope[2] * row[2];
      found.at = side > 0.0 ? std::max(found.at, rest) : std::min(found.at, rest);
    }
    return found;
  };
  return Planes{plane(lows, low_mean, -1.0), plane(highs, high_mean, 1.0)};
}

bool FilterDomain::update_maps(const Domain& domain) {
  for (const auto& each : handled_) {
    if (!each) continue;
    const auto planes = planes_of(*each->reach, domain, each->tool_column);
    if (!planes) return false;
    const std::size_t column = each->tool_column;
    const Plane& low = planes->low;
    const Plane& high = planes->high;
    program_->change_row(
        each->map_row,
        {{{column, low.x}, {column + 1, low.y}, {column + 2, low.z}, {column + 3, -1.0}}, -low.at});
    program_->change_row(
        each->map_row + 1,
        {{{column, -high.x}, {column + 1, -high.y}, {column + 2, -high.z}, {column + 3, 1.0}}, high.at});
  }
  return true;
}

void FilterDomain::load(const Domain& domain) {
  for (std::size_t k = 0; k < domain.size(); ++k) program_->bound(k, domain[k].low, domain[k].high);
}

std::optional<Domain> FilterDomain::filter(const Domain& domain) {
  Domain now = domain;
  // Tool boxes without any regression: equations of two variables.
  for (const auto& each : handled_) {
    if (!each) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double rise = rows_[each->map_row - 3 + axis].high;
      Interval& tool = now[each->tool_column + axis];
      const Interval object = now[each->object_column + axis];
      tool = {std::max(tool.low, object.low + rise - 1e-9), std::min(tool.high, object.high + rise + 1e-9)};
      if (tool.low > tool.high + kTolerance) return std::nullopt;
    }
  }
  for (int round = 0; round < kMostRounds; ++round) {
    if (!update_maps(now)) return std::nullopt;
    load(now);
    double change = 0.0;
    for (std::size_t k = 0; k < now.size(); ++k) {
      if (now[k].high - now[k].low < 1e-9) continue;
      const auto low = program_->least(k);
      if (!low) return std::nullopt;
      const auto high = program_->largest(k);
      if (!high) return std::nullopt;
      const Interval next{std::max(now[k].low, *low), std::min(now[k].high, *high)};
      if (next.low > next.high + kTolerance) return std::nullopt;
      change = std::max({change, next.low - now[k].low, now[k].high - next.high});
      now[k] = {std::min(next.low, next.high), next.high};
      program_->bound(k, now[k].low, now[k].high);
    }
    if (round == 0 && !program_->least(0)) return std::nullopt;  // all may be points
    if (change <= epsilon_) return now;
  }
  return now;
}

std::optional<Domain> FilterDomain::assign(const Domain& domain, const tamp::Configuration& to) const {
  const Handled& handled = *handled_[to.action];
  Domain next = domain;
  const auto put = [&](std::size_t column, double value) {
    Interval& at = next[column];
    if (value < at.low - kTolerance || value > at.high + kTolerance) return false;
    at = {value, value};
    return true;
  };
  // On the turn that the domain has.
  const auto put_angle = [&](std::size_t column, double value) {
    const Interval at = next[column];
    const double turn = std::ceil((at.low - kTolerance - value) / (2.0 * kPi));
    return put(column, value + 2.0 * kPi * turn);
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!put(handled.object_column + axis, tamp::metres_of(to.at[axis]))) return std::nullopt;
    if (!put(handled.tool_column + axis, tamp::metres_of(to.tool[axis]))) return std::nullopt;
  }
  if (!put_angle(handled.object_column + 3, tamp::radians_of(to.angle))) return std::nullopt;
  if (!put_angle(handled.tool_column + 3, tamp::radians_of(to.tool_angle))) return std::nullopt;
  return next;
}

}  // namespace stepwright::bench
