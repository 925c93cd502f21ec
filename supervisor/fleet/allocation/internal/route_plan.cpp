#include "supervisor/fleet/allocation/internal/route_plan.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace stepwright::fleet::internal {

RoutePlan::RoutePlan(const TripModel& model)
    : model_(&model),
      routes_(model.vehicles()),
      profiles_(model.vehicles()),
      vehicle_of_(model.trips(), kNone),
      pick_up_fixed_(model.trips(), 0),
      set_down_fixed_(model.trips(), 0),
      begin_ms_(model.stops(), 0) {
  for (StopIndex stop = 0; stop < model.stops(); ++stop) {
    earliest_ms_.push_back(model.earliest_ms(stop));
    latest_ms_.push_back(model.latest_ms(stop));
  }
  for (std::uint32_t v = 0; v < model.vehicles(); ++v) {
    starts_ms_.push_back(model.start_ms(v));
    routes_[v] = model.driver(v).fixed;
    for (const StopIndex stop : routes_[v]) {
      vehicle_of_[trip_of(stop)] = v;
      (is_pick_up(stop) ? pick_up_fixed_ : set_down_fixed_)[trip_of(stop)] = 1;
    }
    refresh(v);
  }
  for (std::uint32_t t = 0; t < model.trips(); ++t) {
    if (set_down_fixed_[t] == 0) missing_.push_back(t);
  }
}

bool RoutePlan::removable(std::uint32_t trip) const {
  return set_down_fixed_[trip] == 0 && std::ranges::find(missing_, trip) == missing_.end();
}

Score RoutePlan::score() const {
  Score out;
  for (std::uint32_t v = 0; v < routes_.size(); ++v) {
    out.travel_ms += profiles_[v].travel_ms;
    if (routes_[v].empty() && model_->driver(v).finish == kNone) continue;
    out.makespan_ms = std::max(out.makespan_ms, profiles_[v].finish_ms);
  }
  if (missing_.empty()) out.tardiness_ms = tardiness_ms(*model_, begin_ms_);
  return out;
}

std::span<const Insertion> RoutePlan::insertions(std::uint32_t trip) {
  candidates_.clear();
  for (std::uint32_t v = 0; v < routes_.size(); ++v) candidate_insertions(trip, v);
  return candidates_;
}

bool RoutePlan::range(std::uint32_t trip, std::uint32_t vehicle, std::uint32_t& first,
                      std::uint32_t& end) const {
  const Route& route = routes_[vehicle];
  const Driver& driver = model_->driver(vehicle);
  first = static_cast<std::uint32_t>(driver.fixed.size());
  end = static_cast<std::uint32_t>(route.size());
  if (model_->trip(trip).vehicles[vehicle] == 0) return false;
  const auto position = [&](StopIndex stop) {
    return static_cast<std::uint32_t>(std::ranges::find(route, stop) - route.begin());
  };
  for (const std::uint32_t before : model_->trip(trip).predecessors) {
    if (vehicle_of_[before] == kNone) continue;
    if (vehicle_of_[before] != vehicle) return false;
    const std::uint32_t at = position(set_down_of(before));
    if (at < route.size()) first = std::max(first, at + 1);
  }
  for (const std::uint32_t after : model_->trip(trip).successors) {
    if (vehicle_of_[after] == kNone) continue;
    if (vehicle_of_[after] != vehicle) return false;
    end = std::min(end, position(pick_up_of(after)));
  }
  return first <= end;
}

void RoutePlan::candidate_insertions(std::uint32_t trip, std::uint32_t vehicle) {
  std::uint32_t first = 0, end = 0;
  if (!range(trip, vehicle, first, end)) return;
  other_finish_ms_ = 0;
  for (std::uint32_t v = 0; v < routes_.size(); ++v) {
    if (v == vehicle || (routes_[v].empty() && model_->driver(v).finish == kNone)) continue;
    other_finish_ms_ = std::max(other_finish_ms_, profiles_[v].finish_ms);
  }
  const Profile& profile = profiles_[vehicle];
  if (pick_up_fixed_[trip] != 0) {
    place_set_down(trip, vehicle, kNone, first, end, profile.ready_ms[first], place_before(vehicle, first),
                   0);
    return;
  }
  const StopIndex up = pick_up_of(trip);
  for (std::uint32_t at = first; at <= end; ++at) {
    if (profile.load[at] + model_->trip(trip).amount > model_->driver(vehicle).capacity) continue;
    const std::uint32_t before = place_before(vehicle, at);
    const std::int32_t way_ms = model_->way_ms(vehicle, before, model_->place(up));
    if (way_ms >= kNoWay) continue;
    const std::int64_t begin_ms = std::max<std::int64_t>(earliest_ms_[up], profile.ready_ms[at] + way_ms);
    if (begin_ms > latest_ms_[up]) continue;
    place_set_down(trip, vehicle, at, at, end, begin_ms + model_->service_ms(up), model_->place(up), way_ms);
  }
}

// The vehicle stands at `place` before stop `first` and has driven `added_ms` since the one before.
void RoutePlan::place_set_down(std::uint32_t trip, std::uint32_t vehicle, std::uint32_t pick_up,
                               std::uint32_t first, std::uint32_t end, std::int64_t ready_ms,
                               std::uint32_t place, std::int64_t added_ms) {
  const Route& route = routes_[vehicle];
  const Profile& profile = profiles_[vehicle];
  const AllocationObjective& weights = model_->problem().objective;
  const StopIndex down = set_down_of(trip);
  // A pick-up that is fixed counts already, up to the end of the route.
  const std::uint32_t extra = pick_up == kNone ? 0 : model_->trip(trip).amount;
  // What the vehicle drives from the change on to stop `at`, as the route is now.
  std::int64_t replaced_ms = 0;
  for (std::uint32_t at = first; at <= end; ++at) {
    if (at > first) {
      const StopIndex passed = route[at - 1];
      const std::int32_t way_ms = model_->way_ms(vehicle, place, model_->place(passed));
      const bool room = profile.load[at] + extra <= model_->driver(vehicle).capacity;
      if (way_ms >= kNoWay || !room) return;
      ready_ms = std::max<std::int64_t>(earliest_ms_[passed], ready_ms + way_ms);
      if (ready_ms > latest_ms_[passed]) return;
      ready_ms += model_->service_ms(passed);
      added_ms += way_ms;
      replaced_ms += gap_ms(vehicle, at - 1, place_before(vehicle, at - 1));
      place = model_->place(passed);
    }
    const std::int32_t way_ms = model_->way_ms(vehicle, place, model_->place(down));
    if (way_ms >= kNoWay) continue;
    const std::int64_t begin_ms = std::max<std::int64_t>(earliest_ms_[down], ready_ms + way_ms);
    if (begin_ms > latest_ms_[down]) continue;
    const std::int64_t onward_ms = gap_ms(vehicle, at, model_->place(down));
    const auto rest = tail(vehicle, at, begin_ms + model_->service_ms(down), model_->place(down));
    if (!rest || onward_ms >= kNoWay) continue;
    const std::int64_t old_gap_ms = gap_ms(vehicle, at, place_before(vehicle, at));
    const std::int64_t travel_ms = added_ms + way_ms + onward_ms - replaced_ms - old_gap_ms;
    const std::int64_t longer_ms =
        std::max<std::int64_t>(0, rest->finish_ms - std::max(other_finish_ms_, profile.finish_ms));
    const std::int64_t later_ms = rest->later_ms + late_ms(down, begin_ms);
    const double cost =
        static_cast<double>(weights.makespan) * static_cast<double>(longer_ms) +
        static_cast<double>(weights.travel) * static_cast<double>(travel_ms) +
        static_cast<double>(weights.tardiness) * static_cast<double>(later_ms) +
        (spread_ * weights.makespan + 0.01) * static_cast<double>(rest->finish_ms - profile.finish_ms);
    candidates_.push_back({cost, vehicle, pick_up, at});
  }
}

std::optional<RoutePlan::Tail> RoutePlan::tail(std::uint32_t vehicle, std::uint32_t at, std::int64_t ready_ms,
                                               std::uint32_t place) const {
  const Route& route = routes_[vehicle];
  const Profile& profile = profiles_[vehicle];
  Tail out{ready_ms + gap_ms(vehicle, at, place), 0};
  if (at < route.size()) {
    const std::int64_t begin_ms = std::max<std::int64_t>(earliest_ms_[route[at]], out.finish_ms);
    if (begin_ms > profile.latest_ms[at]) return std::nullopt;
    out.finish_ms = std::max(begin_ms + profile.after_ms[at], profile.floor_ms[at]);
    if (model_->problem().objective.tardiness > 0) out.later_ms = later_ms(vehicle, at, begin_ms);
  }
  if (out.finish_ms > kHorizon_ms) return std::nullopt;
  return out;
}

std::int64_t RoutePlan::later_ms(std::uint32_t vehicle, std::uint32_t at, std::int64_t begin_ms) const {
  const Route& route = routes_[vehicle];
  std::int64_t sum_ms = 0;
  for (std::uint32_t k = at; k < route.size(); ++k) {
    const StopIndex stop = route[k];
    if (begin_ms == begin_ms_[stop]) break;  // nothing changes from here on
    sum_ms += late_ms(stop, begin_ms) - late_ms(stop, begin_ms_[stop]);
    if (k + 1 == route.size()) break;
    const std::int64_t next_ms =
        begin_ms + model_->service_ms(stop) + gap_ms(vehicle, k + 1, model_->place(stop));
    begin_ms = std::max<std::int64_t>(earliest_ms_[route[k + 1]], next_ms);
  }
  return sum_ms;
}

std::int64_t RoutePlan::late_ms(StopIndex stop, std::int64_t begin_ms) const {
  const Transport& transport = model_->transport_of(trip_of(stop));
  if (is_pick_up(stop) || !transport.due) return 0;
  const std::int64_t end_ms = begin_ms + model_->service_ms(stop);
  return transport.weight * std::max<std::int64_t>(0, end_ms - transport.due->count());
}

// From `place` to stop `at` of the route, or to the finish.
std::int64_t RoutePlan::gap_ms(std::uint32_t vehicle, std::uint32_t at, std::uint32_t place) const {
  if (at < routes_[vehicle].size()) {
    return model_->way_ms(vehicle, place, model_->place(routes_[vehicle][at]));
  }
  const std::uint32_t finish = model_->driver(vehicle).finish;
  return finish == kNone ? 0 : model_->way_ms(vehicle, place, finish);
}

std::uint32_t RoutePlan::place_before(std::uint32_t vehicle, std::uint32_t at) const {
  return at == 0 ? model_->driver(vehicle).start : model_->place(routes_[vehicle][at - 1]);
}

void RoutePlan::insert(std::uint32_t trip, const Insertion& at) {
  Route& route = routes_[at.vehicle];
  route.insert(route.begin() + at.set_down, set_down_of(trip));
  if (at.pick_up != kNone) route.insert(route.begin() + at.pick_up, pick_up_of(trip));
  vehicle_of_[trip] = at.vehicle;
  std::erase(missing_, trip);
  refresh(at.vehicle);
}

void RoutePlan::remove(std::uint32_t trip) {
  const std::uint32_t vehicle = vehicle_of_[trip];
  std::erase(routes_[vehicle], set_down_of(trip));
  if (pick_up_fixed_[trip] == 0) {
    std::erase(routes_[vehicle], pick_up_of(trip));
    vehicle_of_[trip] = kNone;
  }
  missing_.push_back(trip);
  refresh(vehicle);
}

void RoutePlan::set_windows(const Network& network) {
  for (StopIndex stop = 0; stop < model_->stops(); ++stop) {
    earliest_ms_[stop] = network.earliest_ms(TripModel::at(stop));
    latest_ms_[stop] = std::min(network.latest_ms(TripModel::at(stop)), model_->latest_ms(stop));
  }
  for (std::uint32_t v = 0; v < routes_.size(); ++v) {
    starts_ms_[v] = network.earliest_ms(model_->start_of(v));
    refresh(v);
  }
}

void RoutePlan::refresh(std::uint32_t vehicle) {
  const Route& route = routes_[vehicle];
  Profile& profile = profiles_[vehicle];
  const std::size_t stops = route.size();
  profile.ready_ms.assign(stops + 1, starts_ms_[vehicle]);
  profile.load.assign(stops + 1, 0);
  profile.latest_ms.assign(stops, 0);
  profile.after_ms.assign(stops, 0);
  profile.floor_ms.assign(stops, 0);
  profile.travel_ms = 0;
  for (std::uint32_t k = 0; k < stops; ++k) {
    const StopIndex stop = route[k];
    const std::int64_t way_ms = gap_ms(vehicle, k, place_before(vehicle, k));
    const std::uint32_t amount = model_->trip(trip_of(stop)).amount;
    begin_ms_[stop] = static_cast<std::int32_t>(std::min<std::int64_t>(
        kNoWay, std::max<std::int64_t>(earliest_ms_[stop], profile.ready_ms[k] + way_ms)));
    profile.ready_ms[k + 1] = static_cast<std::int64_t>(begin_ms_[stop]) + model_->service_ms(stop);
    profile.load[k + 1] = is_pick_up(stop) ? profile.load[k] + amount : profile.load[k] - amount;
    profile.travel_ms += way_ms;
  }
  const auto end = static_cast<std::uint32_t>(stops);
  const std::int64_t home_ms = gap_ms(vehicle, end, place_before(vehicle, end));
  profile.travel_ms += home_ms;
  profile.finish_ms = profile.ready_ms[stops] + home_ms;
  std::int64_t latest_ms = kHorizon_ms - home_ms;
  for (std::uint32_t k = end; k-- > 0;) {
    latest_ms = std::min<std::int64_t>(latest_ms - model_->service_ms(route[k]), latest_ms_[route[k]]);
    profile.latest_ms[k] = latest_ms;
    const std::int64_t onward_ms = model_->service_ms(route[k]) +
                                   (k + 1 == end ? home_ms : gap_ms(vehicle, k + 1, model_->place(route[k])));
    if (k + 1 == end) {
      profile.after_ms[k] = onward_ms;
    } else {
      const std::int64_t next_ms = earliest_ms_[route[k + 1]];
      profile.after_ms[k] = onward_ms + profile.after_ms[k + 1];
      profile.floor_ms[k] = std::max(profile.floor_ms[k + 1], next_ms + profile.after_ms[k + 1]);
    }
    latest_ms -= gap_ms(vehicle, k, place_before(vehicle, k));
  }
}

}  // namespace stepwright::fleet::internal
