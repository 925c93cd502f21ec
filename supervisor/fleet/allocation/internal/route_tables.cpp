#include "supervisor/fleet/allocation/internal/route_tables.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace stepwright::fleet::internal {

namespace {

std::int32_t sum(std::int32_t a, std::int32_t b) {
  return std::min(a + b, kNoWay);
}

void keep_least(Effort& best, const Effort& other, std::int32_t way_ms) {
  best.time_ms = std::min(best.time_ms, sum(other.time_ms, way_ms));
  best.travel_ms = std::min(best.travel_ms, sum(other.travel_ms, way_ms));
}

// Whether one table serves both vehicles.
bool same_kind(const TripModel& model, std::uint32_t a, std::uint32_t b) {
  const Driver &first = model.driver(a), &second = model.driver(b);
  if (first.vehicle_class != second.vehicle_class || first.capacity != second.capacity) return false;
  if (first.finish != second.finish) return false;
  for (std::uint32_t t = 0; t < model.trips(); ++t) {
    if (model.trip(t).vehicles[a] != model.trip(t).vehicles[b]) return false;
  }
  return true;
}

constexpr std::size_t kMostBytes = std::size_t(256) << 20;

}  // namespace

bool tables_fit(const TripModel& model) {
  if (model.trips() > kMostTableTrips) return false;
  std::size_t bytes = sizeof(Effort) * model.stops();
  for (std::uint32_t t = 0; t < model.trips(); ++t) bytes *= 3;
  std::vector<std::uint32_t> kinds;
  for (std::uint32_t v = 0; v < model.vehicles(); ++v) {
    const auto like = [&](std::uint32_t other) { return same_kind(model, other, v); };
    if (std::ranges::none_of(kinds, like)) kinds.push_back(v);
  }
  return bytes * kinds.size() <= kMostBytes;
}

RouteTables::RouteTables(const TripModel& model) : model_(model) {
  assert(tables_fit(model));
  const TripMask masks = TripMask(1) << model.trips();
  digits_.assign(masks, 0);
  std::uint32_t power = 1;
  for (std::uint32_t t = 0; t < model.trips(); ++t, power *= 3) {
    for (TripMask mask = 0; mask < masks; ++mask) {
      if ((mask >> t & 1) == 0) continue;
      digits_[mask] += power;
    }
  }
  for (std::uint32_t v = 0; v < model.vehicles(); ++v) {
    std::size_t kind = 0;
    while (kind < kinds_.size() && !same_kind(model, kinds_[kind].vehicle, v)) ++kind;
    if (kind == kinds_.size()) {
      kinds_.push_back({v, {}});
      fill(kinds_.back());
    }
    kind_of_.push_back(kind);
    whole_.push_back(from_start(v));
  }
  share();
}

Effort RouteTables::finish_from(std::uint32_t vehicle, std::uint32_t place) const {
  const std::uint32_t finish = model_.driver(vehicle).finish;
  if (finish == kNone) return {0, 0};
  const std::int32_t way_ms = model_.least_way_ms(vehicle, place, finish);
  return {way_ms, way_ms};
}

void RouteTables::fill(Kind& kind) const {
  const std::uint32_t trips = model_.trips(), stops = model_.stops(), v = kind.vehicle;
  std::size_t codes = 1;
  for (std::uint32_t t = 0; t < trips; ++t) codes *= 3;
  kind.rest.assign(codes * stops, {});
  std::vector<std::pair<StopIndex, Effort>> next;
  for (std::size_t code = 0; code < codes; ++code) {
    Effort* const row = &kind.rest[code * stops];
    if (code == 0) {
      for (StopIndex last = 0; last < stops; ++last) row[last] = finish_from(v, model_.place(last));
      continue;
    }
    // A stop takes one from the digit of its trip: 2 to be picked up, 1 aboard, 0 done or not ours.
    next.clear();
    std::uint32_t load = 0;
    std::size_t left = code;
    for (std::uint32_t t = 0; t < trips; ++t, left /= 3) {
      if (left % 3 == 1) load += model_.trip(t).amount;
    }
    left = code;
    std::size_t power = 1;
    for (std::uint32_t t = 0; t < trips; ++t, left /= 3, power *= 3) {
      const std::size_t digit = left % 3;
      if (digit == 0 || model_.trip(t).vehicles[v] == 0) continue;
      if (digit == 2 && load + model_.trip(t).amount > model_.driver(v).capacity) continue;
      const StopIndex stop = digit == 2 ? pick_up_of(t) : set_down_of(t);
      Effort then = kind.rest[(code - power) * stops + stop];
      if (then.travel_ms >= kNoWay) continue;
      then.time_ms = sum(then.time_ms, model_.service_ms(stop));
      next.emplace_back(stop, then);
    }
    for (StopIndex last = 0; last < stops; ++last) {
      for (const auto& [stop, then] : next) {
        keep_least(row[last], then, model_.least_way_ms(v, model_.place(last), model_.place(stop)));
      }
    }
  }
}

std::vector<Effort> RouteTables::from_start(std::uint32_t vehicle) const {
  const Driver& driver = model_.driver(vehicle);
  const Kind& kind = kinds_[kind_of_[vehicle]];
  std::vector<Effort> out(digits_.size());
  for (TripMask mask = 0; mask < out.size(); ++mask) {
    Effort& effort = out[mask];
    if (mask == 0) effort = finish_from(vehicle, driver.start);
    for (TripMask left = mask; left != 0; left &= left - 1) {
      const auto t = static_cast<std::uint32_t>(std::countr_zero(left));
      if (model_.trip(t).vehicles[vehicle] == 0) continue;
      const std::size_t code = 2 * static_cast<std::size_t>(digits_[mask]) - digits_[TripMask(1) << t];
      Effort then = kind.rest[code * model_.stops() + pick_up_of(t)];
      then.time_ms = sum(then.time_ms, model_.service_ms(pick_up_of(t)));
      keep_least(effort, then, model_.least_way_ms(vehicle, driver.start, model_.place(pick_up_of(t))));
    }
    if (mask != 0 || driver.finish != kNone) effort.time_ms = sum(effort.time_ms, model_.start_ms(vehicle));
  }
  return out;
}

void RouteTables::share() {
  shared_.assign(model_.vehicles() + 1, std::vector<Effort>(digits_.size()));
  shared_.back()[0] = {0, 0};
  for (std::uint32_t v = model_.vehicles(); v-- > 0;) {
    for (TripMask mask = 0; mask < digits_.size(); ++mask) {
      Effort& best = shared_[v][mask];
      for (TripMask own = mask;; own = (own - 1) & mask) {
        const Effort &mine = whole_[v][own], &others = shared_[v + 1][mask & ~own];
        best.time_ms = std::min(best.time_ms, std::max(mine.time_ms, others.time_ms));
        best.travel_ms = std::min(best.travel_ms, sum(mine.travel_ms, others.travel_ms));
        if (own == 0) break;
      }
    }
  }
}

}  // namespace stepwright::fleet::internal
