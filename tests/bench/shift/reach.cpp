#include "tests/bench/shift/reach.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace stepwright::bench::shift {

namespace {

using geometry::Point;

double distance_to(const geometry::ConvexPolygon& polygon, Point at) {
  if (polygon.contains(at)) return 0.0;
  const auto corners = polygon.corners();
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point a = corners[k], side = corners[(k + 1) % corners.size()] - a;
    const Point from = at - a;
    const double share =
        (from.x_m * side.x_m + from.y_m * side.y_m) / (side.x_m * side.x_m + side.y_m * side.y_m);
    nearest_m = std::min(nearest_m, geometry::distance(at, a + std::clamp(share, 0.0, 1.0) * side));
  }
  return nearest_m;
}

// Small cells of the floor, and in which of them a disc fits.
class Cells {
 public:
  Cells(const Scenario& scenario, const ReachOptions& options)
      : frame_(scenario.hall.grid.frame()), step_m_(options.step_m) {
    columns_ = static_cast<int>(std::ceil(frame_.columns * frame_.resolution_m / step_m_ - 1e-9));
    rows_ = static_cast<int>(std::ceil(frame_.rows * frame_.resolution_m / step_m_ - 1e-9));
    // From the middle of a cell to the obstacle, where the disc is anywhere in the cell.
    least_m_ = options.radius_m - step_m_ * std::sqrt(0.5) - 1e-9;
    fits_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 1);
    for (int row = 0; row < frame_.rows; ++row) {
      for (int column = 0; column < frame_.columns; ++column) {
        if (scenario.hall.grid.blocked({column, row}))
          close(fits_, fleet::cell_square(frame_, {column, row}));
      }
    }
  }

  std::vector<char> without(std::span<const Standing> stood, double at_s) const {
    std::vector<char> fits = fits_;
    for (const Standing& each : stood)
      if (each.begin_s <= at_s && at_s < each.end_s) close(fits, each.area);
    return fits;
  }
  std::size_t at(Point point) const {
    const auto on = [&](double from_m, int count) {
      return static_cast<std::size_t>(std::clamp(static_cast<int>(from_m / step_m_), 0, count - 1));
    };
    return on(point.y_m - frame_.origin.y_m, rows_) * static_cast<std::size_t>(columns_) +
           on(point.x_m - frame_.origin.x_m, columns_);
  }
  Point middle(std::size_t cell) const {
    const auto columns = static_cast<std::size_t>(columns_);
    return frame_.origin + Point{step_m_ * (static_cast<double>(cell % columns) + 0.5),
                                 step_m_ * (static_cast<double>(cell / columns) + 0.5)};
  }
  // All that is joined to what has been reached, by cells that touch.
  void flood(const std::vector<char>& fits, std::vector<char>& reached) const {
    std::vector<std::size_t> open;
    for (std::size_t cell = 0; cell < reached.size(); ++cell)
      if (reached[cell] != 0 && fits[cell] != 0) open.push_back(cell);
    const auto columns = static_cast<std::size_t>(columns_);
    while (!open.empty()) {
      const auto row = static_cast<int>(open.back() / columns),
                 column = static_cast<int>(open.back() % columns);
      open.pop_back();
      for (int r = std::max(0, row - 1); r <= std::min(rows_ - 1, row + 1); ++r) {
        for (int c = std::max(0, column - 1); c <= std::min(columns_ - 1, column + 1); ++c) {
          const std::size_t next = static_cast<std::size_t>(r) * columns + static_cast<std::size_t>(c);
          if (fits[next] == 0 || reached[next] != 0) continue;
          reached[next] = 1;
          open.push_back(next);
        }
      }
    }
  }
  double step_m() const { return step_m_; }
  std::size_t size() const { return fits_.size(); }

 private:
  void close(std::vector<char>& fits, const geometry::ConvexPolygon& area) const {
    const auto on = [&](double from_m, int count) {
      return std::clamp(static_cast<int>(std::floor(from_m / step_m_)), 0, count - 1);
    };
    const geometry::Box& box = area.bounds();
    const Point low = box.low - frame_.origin, high = box.high - frame_.origin;
    for (int row = on(low.y_m - least_m_, rows_); row <= on(high.y_m + least_m_, rows_); ++row) {
      for (int c = on(low.x_m - least_m_, columns_); c <= on(high.x_m + least_m_, columns_); ++c) {
        const std::size_t cell =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c);
        if (fits[cell] != 0 && distance_to(area, middle(cell)) < least_m_) fits[cell] = 0;
      }
    }
  }

  fleet::GridFrame frame_;
  double step_m_;
  double least_m_ = 0.0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<char> fits_;
};

}  // namespace

Ready ready_at(const Scenario& scenario, std::span<const Standing> stood, const Transport& transport,
               const Delivery& delivery) {
  Ready ready{scenario.stations[transport.from].position(), transport.release_s + transport.pick_up_s};
  for (const Standing& each : stood) {
    const bool aboard = each.vehicle && each.vehicle == delivery.vehicle && delivery.picked_s &&
                        each.begin_s >= *delivery.picked_s &&
                        (!delivery.delivered_s || each.begin_s < *delivery.delivered_s);
    if (aboard) ready = {each.place, each.end_s, each.vehicle};
  }
  return ready;
}

double earliest_delivery_s(const Scenario& scenario, std::span<const Standing> stood,
                           const Transport& transport, const Ready& ready, const ReachOptions& options) {
  if (std::isinf(ready.at_s)) return ready.at_s;
  const Cells cells(scenario, options);
  const Point from = ready.at;
  const Point to = scenario.stations[transport.to].position();
  const double loaded_s = ready.at_s;
  std::set<double> changes = {loaded_s};
  for (const Standing& each : stood) {
    if (each.begin_s > loaded_s) changes.insert(each.begin_s);
    if (each.end_s > loaded_s) changes.insert(each.end_s);
  }
  std::vector<char> reached(cells.size(), 0);
  reached[cells.at(from)] = 1;
  for (const double change_s : changes) {
    double nearest_m = std::numeric_limits<double>::infinity();
    for (std::size_t cell = 0; cell < reached.size(); ++cell)
      if (reached[cell] != 0) nearest_m = std::min(nearest_m, geometry::distance(cells.middle(cell), to));
    cells.flood(cells.without(stood, change_s), reached);
    if (reached[cells.at(to)] == 0) continue;
    const double way_m = std::max(0.0, nearest_m - cells.step_m());
    const double there_s = std::max(change_s + way_m / options.top_speed_m_s,
                                    loaded_s + geometry::distance(from, to) / options.top_speed_m_s);
    return there_s + transport.set_down_s;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace stepwright::bench::shift
