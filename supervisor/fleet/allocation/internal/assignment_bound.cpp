#include "supervisor/fleet/allocation/internal/assignment_bound.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "supervisor/fleet/allocation/internal/evaluation.h"

namespace stepwright::fleet::internal {

namespace {

constexpr std::size_t kMostAssigned = 500;

// Costs of coming to a stop (row) from another one or from the start of a vehicle (column).
class Origins {
 public:
  explicit Origins(const TripModel& model) : model_(model) {}

  std::size_t rows() const { return model_.stops(); }
  std::size_t columns() const { return model_.stops() + model_.vehicles(); }

  std::int64_t cost(std::size_t row, std::size_t column) const {
    const auto to = static_cast<StopIndex>(row);
    if (column >= model_.stops()) {
      const auto v = static_cast<std::uint32_t>(column - model_.stops());
      if (!is_pick_up(to) || model_.trip(trip_of(to)).vehicles[v] == 0) return kNoWay;
      return model_.least_way_ms(v, model_.driver(v).start, model_.place(to));
    }
    const auto from = static_cast<StopIndex>(column);
    const std::uint32_t a = trip_of(from), b = trip_of(to);
    if (a == b) return is_pick_up(from) && !is_pick_up(to) ? least_way_ms(from, to, 0) : kNoWay;
    // Only from a set-down to a pick-up the two need not be aboard at once, and only from there.
    const bool apart = !is_pick_up(from) && is_pick_up(to);
    return least_way_ms(from, to, apart ? 0 : model_.trip(a).amount + model_.trip(b).amount);
  }

 private:
  std::int64_t least_way_ms(StopIndex from, StopIndex to, std::uint32_t capacity) const {
    std::int64_t least_ms = kNoWay;
    for (std::uint32_t v = 0; v < model_.vehicles(); ++v) {
      if (model_.driver(v).capacity < capacity) continue;
      if (model_.trip(trip_of(from)).vehicles[v] == 0 || model_.trip(trip_of(to)).vehicles[v] == 0) continue;
      least_ms =
          std::min<std::int64_t>(least_ms, model_.least_way_ms(v, model_.place(from), model_.place(to)));
    }
    return least_ms;
  }
  const TripModel& model_;
};

// Shortest augmenting paths with potentials; the least sum, each column used once at most.
std::int64_t least_assignment(const Origins& origins) {
  constexpr std::int64_t kFar = std::numeric_limits<std::int64_t>::max() / 4;
  const std::size_t rows = origins.rows(), columns = origins.columns();
  std::vector<std::int64_t> costs(rows * columns);
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = 0; c < columns; ++c) costs[r * columns + c] = origins.cost(r, c);
  }
  // Column 0 and row 0 stand for none.
  std::vector<std::int64_t> of_row(rows + 1, 0), of_column(columns + 1, 0);
  std::vector<std::size_t> row_of(columns + 1, 0), way(columns + 1, 0);
  for (std::size_t row = 1; row <= rows; ++row) {
    row_of[0] = row;
    std::size_t at = 0;
    std::vector<std::int64_t> slack(columns + 1, kFar);
    std::vector<char> used(columns + 1, 0);
    do {
      used[at] = 1;
      const std::size_t r = row_of[at];
      std::int64_t least = kFar;
      std::size_t next = 0;
      for (std::size_t c = 1; c <= columns; ++c) {
        if (used[c] != 0) continue;
        const std::int64_t reduced = costs[(r - 1) * columns + c - 1] - of_row[r] - of_column[c];
        if (reduced < slack[c]) {
          slack[c] = reduced;
          way[c] = at;
        }
        if (slack[c] < least) {
          least = slack[c];
          next = c;
        }
      }
      for (std::size_t c = 0; c <= columns; ++c) {
        if (used[c] != 0) {
          of_row[row_of[c]] += least;
          of_column[c] -= least;
        } else {
          slack[c] -= least;
        }
      }
      at = next;
    } while (row_of[at] != 0);
    for (; at != 0; at = way[at]) row_of[at] = row_of[way[at]];
  }
  return -of_column[0];
}

}  // namespace

std::int64_t least_travel_ms(const TripModel& model) {
  const Origins origins(model);
  if (model.stops() == 0) return 0;
  if (model.stops() <= kMostAssigned) return least_assignment(origins);
  std::int64_t sum_ms = 0;
  for (std::size_t row = 0; row < origins.rows(); ++row) {
    std::int64_t least_ms = kNoWay;
    for (std::size_t c = 0; c < origins.columns(); ++c) least_ms = std::min(least_ms, origins.cost(row, c));
    sum_ms += least_ms;
  }
  return sum_ms;
}

std::int64_t least_value(const TripModel& model) {
  if (model.vehicles() == 0) return 0;
  Score score;
  score.travel_ms = least_travel_ms(model);
  std::int64_t work_ms = score.travel_ms;
  std::vector<std::int32_t> begin_ms;
  for (StopIndex stop = 0; stop < model.stops(); ++stop) {
    begin_ms.push_back(model.earliest_ms(stop));
    work_ms += model.service_ms(stop);
    score.makespan_ms = std::max<std::int64_t>(
        score.makespan_ms, static_cast<std::int64_t>(begin_ms.back()) + model.service_ms(stop));
  }
  std::int64_t first_ms = kHorizon_ms;
  for (std::uint32_t v = 0; v < model.vehicles(); ++v) {
    first_ms = std::min<std::int64_t>(first_ms, model.start_ms(v));
  }
  const std::int64_t vehicles = model.vehicles();
  if (model.trips() > 0) {
    score.makespan_ms = std::max(score.makespan_ms, first_ms + (work_ms + vehicles - 1) / vehicles);
  }
  score.tardiness_ms = tardiness_ms(model, begin_ms);
  return score.value(model.problem().objective);
}

}  // namespace stepwright::fleet::internal
