#include "supervisor/tamp/planner/packing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stepwright::tamp::planner {

namespace {

constexpr double kRounded_m = 1e-9;

struct Disc {
  PlanePoint at;
  double radius_m = 0.0;
};

class Packer {
 public:
  Packer(const PackProblem& problem, std::size_t most_nodes) : problem_(problem), nodes_(most_nodes) {
    for (std::size_t k = 0; k < problem.standing.size(); ++k)
      discs_.push_back({problem.standing[k], problem.standing_radii_m[k]});
    order_.resize(problem.radii_m.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::ranges::stable_sort(
        order_, [&](std::size_t a, std::size_t b) { return problem.radii_m[a] > problem.radii_m[b]; });
  }

  std::optional<std::vector<PlanePoint>> run() {
    if (!seek(0)) return std::nullopt;
    std::vector<PlanePoint> places(order_.size());
    for (std::size_t k = 0; k < order_.size(); ++k)
      places[order_[k]] = discs_[problem_.standing.size() + k].at;
    return places;
  }

 private:
  bool seek(std::size_t k) {
    if (k == order_.size()) return true;
    const double radius_m = problem_.radii_m[order_[k]];
    const double half_x = 0.5 * problem_.size_x_m - radius_m, half_y = 0.5 * problem_.size_y_m - radius_m;
    if (half_x < -kRounded_m || half_y < -kRounded_m) return false;
    for (const PlanePoint& at : candidates(radius_m, std::max(0.0, half_x), std::max(0.0, half_y))) {
      if (nodes_ == 0) return false;
      --nodes_;
      if (!fits(at, radius_m, half_x, half_y)) continue;
      discs_.push_back({at, radius_m});
      if (seek(k + 1)) return true;
      discs_.pop_back();
    }
    return false;
  }

  bool fits(const PlanePoint& at, double radius_m, double half_x, double half_y) const {
    if (std::abs(at.x_m) > half_x + kRounded_m || std::abs(at.y_m) > half_y + kRounded_m) return false;
    return std::ranges::all_of(discs_, [&](const Disc& each) {
      return std::hypot(at.x_m - each.at.x_m, at.y_m - each.at.y_m) >=
             radius_m + each.radius_m + problem_.apart_m - kRounded_m;
    });
  }

  // Corners, then where it touches a side and a disc, then where it touches two discs.
  std::vector<PlanePoint> candidates(double radius_m, double half_x, double half_y) const {
    if (discs_.empty()) return {{half_x, half_y}};  // the other corners are mirror images
    std::vector<PlanePoint> all = {
        {half_x, half_y}, {half_x, -half_y}, {-half_x, half_y}, {-half_x, -half_y}};
    for (const Disc& each : discs_) {
      const double away = radius_m + each.radius_m + problem_.apart_m;
      for (const double side : {half_x, -half_x})
        if (const double d = side - each.at.x_m, rest = away * away - d * d; rest >= 0.0)
          for (const double sign : {1.0, -1.0}) all.push_back({side, each.at.y_m + sign * std::sqrt(rest)});
      for (const double side : {half_y, -half_y})
        if (const double d = side - each.at.y_m, rest = away * away - d * d; rest >= 0.0)
          for (const double sign : {1.0, -1.0}) all.push_back({each.at.x_m + sign * std::sqrt(rest), side});
    }
    for (std::size_t a = 0; a < discs_.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) add_between(discs_[a], discs_[b], radius_m, all);
    return all;
  }

  void add_between(const Disc& a, const Disc& b, double radius_m, std::vector<PlanePoint>& all) const {
    const double from_a = radius_m + a.radius_m + problem_.apart_m,
                 from_b = radius_m + b.radius_m + problem_.apart_m;
    const double dx = b.at.x_m - a.at.x_m, dy = b.at.y_m - a.at.y_m, far = std::hypot(dx, dy);
    if (far < kRounded_m || far > from_a + from_b) return;
    const double along = (far * far + from_a * from_a - from_b * from_b) / (2.0 * far);
    const double square = from_a * from_a - along * along;
    if (square < 0.0) return;
    for (const double across : {std::sqrt(square), -std::sqrt(square)})
      all.push_back(
          {a.at.x_m + (along * dx - across * dy) / far, a.at.y_m + (along * dy + across * dx) / far});
  }

  const PackProblem& problem_;
  std::size_t nodes_;
  std::vector<std::size_t> order_;  // the largest first
  std::vector<Disc> discs_;
};

}  // namespace

std::optional<std::vector<PlanePoint>> pack(const PackProblem& problem, std::size_t most_nodes) {
  return Packer(problem, most_nodes).run();
}

namespace {

// Things of one size in rows and columns over the whole rectangle, a single row in a zigzag: the one with
// most between any two. Nothing where that is less than it has to be.
std::optional<std::vector<PlanePoint>> in_rows(const PackProblem& problem) {
  const std::size_t count = problem.radii_m.size();
  const double radius_m = problem.radii_m.front();
  const double free_x = problem.size_x_m - 2.0 * radius_m, free_y = problem.size_y_m - 2.0 * radius_m;
  if (free_x < 0.0 || free_y < 0.0) return std::nullopt;
  const auto step = [](double free, std::size_t parts) {
    return parts > 1 ? free / static_cast<double>(parts - 1) : 1e9;
  };
  std::size_t best_columns = 0;
  double best_m = 2.0 * radius_m + problem.apart_m;
  for (std::size_t columns = 1; columns <= count; ++columns) {
    const std::size_t rows = (count + columns - 1) / columns;
    const double x = step(free_x, columns), y = step(free_y, rows);
    double away = std::min(x, y);
    if (rows == 1) away = std::min(std::hypot(x, free_y), 2.0 * x);
    if (columns == 1) away = std::min(std::hypot(y, free_x), 2.0 * y);
    if (away >= best_m) best_m = away, best_columns = columns;
  }
  if (best_columns == 0) return std::nullopt;
  const std::size_t columns = best_columns, rows = (count + columns - 1) / columns;
  std::vector<PlanePoint> places;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t column = k % columns, row = k / columns;
    const auto at = [](double free, std::size_t parts, std::size_t which, std::size_t turn) {
      if (parts == 1) return turn % 2 == 0 ? -0.5 * free : 0.5 * free;
      return free * (static_cast<double>(which) / static_cast<double>(parts - 1) - 0.5);
    };
    places.push_back({at(free_x, columns, column, row), at(free_y, rows, row, column)});
  }
  return places;
}

}  // namespace

std::optional<std::vector<PlanePoint>> spread(PackProblem problem, double most_m) {
  if (problem.radii_m.size() == 1 && problem.standing.empty() &&
      2.0 * problem.radii_m[0] <= std::min(problem.size_x_m, problem.size_y_m))
    return std::vector<PlanePoint>{{}};
  if (problem.radii_m.size() > 1 && problem.standing.empty() &&
      std::ranges::all_of(problem.radii_m, [&](double each) { return each == problem.radii_m.front(); }))
    if (auto places = in_rows(problem)) return places;
  auto best = pack(problem);
  if (!best) return best;
  constexpr int kHalvings = 8;  // of 40 mm: to a fifth of a millimetre
  const double least_m = *std::ranges::min_element(problem.radii_m);
  double low_m = problem.apart_m, high_m = most_m;
  for (int k = 0; k < kHalvings; ++k) {
    problem.apart_m = k == 0 ? high_m : 0.5 * (low_m + high_m);
    std::optional<std::vector<PlanePoint>> found;
    if (!too_many(problem.radii_m.size(), problem.size_x_m, problem.size_y_m, least_m, problem.apart_m))
      found = pack(problem, 1'000);
    if (found) {
      best = std::move(found);
      low_m = problem.apart_m;
      if (k == 0) break;
    } else {
      high_m = problem.apart_m;
    }
  }
  return best;
}

std::size_t most_that_fit(double size_x_m, double size_y_m, double radius_m, double apart_m) {
  const double free_x = size_x_m - 2.0 * radius_m, free_y = size_y_m - 2.0 * radius_m;
  if (free_x < 0.0 || free_y < 0.0) return 0;
  const double away = 2.0 * radius_m + apart_m;
  std::size_t least = static_cast<std::size_t>(-1);
  constexpr std::size_t kMostParts = 64;
  for (std::size_t nx = 1; nx <= kMostParts; ++nx)
    for (std::size_t ny = 1; ny <= kMostParts; ++ny)
      if (std::hypot(free_x / static_cast<double>(nx), free_y / static_cast<double>(ny)) < away - 1e-12)
        least = std::min(least, nx * ny);
  return least;
}

bool too_many(std::size_t count, double size_x_m, double size_y_m, double radius_m, double apart_m) {
  const double free_x = size_x_m - 2.0 * radius_m, free_y = size_y_m - 2.0 * radius_m;
  if (free_x < 0.0 || free_y < 0.0) return count > 0;
  const double away = 2.0 * radius_m + apart_m;
  for (std::size_t nx = 1; nx < count; ++nx)
    for (std::size_t ny = 1; nx * ny < count; ++ny)
      if (std::hypot(free_x / static_cast<double>(nx), free_y / static_cast<double>(ny)) < away - 1e-12)
        return true;
  return false;
}

}  // namespace stepwright::tamp::planner
