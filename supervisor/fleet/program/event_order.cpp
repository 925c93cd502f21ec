#include "supervisor/fleet/program/event_order.h"

#include <utility>

namespace stepwright::fleet {

EventOrder::EventOrder(const FleetPlan& plan, const Interlocks& made) : plan_(plan), made_(made) {
  for (const VehicleMission& mission : plan.missions) {
    first_.push_back(count_);
    count_ += 2 * mission.grown.visits.size() + mission.stops.size() + 1;
  }
  for (std::uint32_t v = 0; v < plan.missions.size(); ++v) {
    add_vehicle(v);
    add_stops(v);
  }
}

void EventOrder::add_vehicle(std::uint32_t v) {
  const std::size_t polygons = plan_.missions[v].grown.visits.size();
  for (std::size_t k = 0; k < polygons; ++k) {
    if (k > 0) require(enter(v, k), enter(v, k - 1));
    for (const Interlock& wait : made_.before[v][k]) {
      require(enter(v, k), leave(wait.vehicle, wait.polygon));
    }
    if (k + 1 < polygons) {
      require(leave(v, k), enter(v, made_.places[v].left_into[k]));
    } else {
      require(leave(v, k), leave(v, k));  // nobody leaves its last polygon
    }
  }
  require(arrived(v), enter(v, polygons - 1));
}

// A stop is made as soon as the vehicle may drive there; behind it the way goes on.
void EventOrder::add_stops(std::uint32_t v) {
  const VehicleMission& mission = plan_.missions[v];
  const std::size_t polygons = mission.grown.visits.size();
  const WaitPlaces& places = made_.places[v];
  for (std::size_t k = 0; k < mission.stops.size(); ++k) {
    const std::size_t in = places.stops_in[k];
    require(stop_done(v, k), enter(v, in));
    if (k > 0) require(stop_done(v, k), stop_done(v, k - 1));
    if (in + 1 < polygons) require(enter(v, in + 1), stop_done(v, k));
    for (std::size_t left = 0; left <= in; ++left) {
      if (places.free_m[left] > mission.stops[k].arc_m) require(leave(v, left), stop_done(v, k));
    }
    require(arrived(v), stop_done(v, k));
  }
}

std::size_t EventOrder::event_of(const MissionEvent& event) const {
  switch (event.kind) {
    case EventKind::Begun:
      return enter(event.vehicle, 0);
    case EventKind::Entered:
      return enter(event.vehicle, event.index);
    case EventKind::StopDone:
      return stop_done(event.vehicle, event.index);
    case EventKind::Left:
      return leave(event.vehicle, event.index);
    case EventKind::Arrived:
      break;
  }
  return arrived(event.vehicle);
}

std::size_t EventOrder::event_of(const TimeWait& wait) const {
  switch (wait.place) {
    case ChartPlace::Start:
      return enter(wait.vehicle, 0);
    case ChartPlace::Polygon:
      return enter(wait.vehicle, wait.index);
    case ChartPlace::StopBegin:
    case ChartPlace::StopEnd:
      return stop_done(wait.vehicle, wait.index);
    case ChartPlace::End:
      break;
  }
  return arrived(wait.vehicle);
}

void EventOrder::require(const TimeWait& wait, const std::vector<MissionEvent>& events) {
  if (wait.event) require(event_of(wait), event_of(events[*wait.event]));
}

void EventOrder::take_back() {
  edges_.pop_back();
}

std::optional<PolygonRef> EventOrder::blocked() const {
  std::vector<std::vector<std::size_t>> after(count_);
  std::vector<std::size_t> open(count_, 0);
  for (const auto& [before, event] : edges_) {
    after[before].push_back(event);
    ++open[event];
  }
  std::vector<std::size_t> ready;
  for (std::size_t event = 0; event < count_; ++event) {
    if (open[event] == 0) ready.push_back(event);
  }
  while (!ready.empty()) {
    const std::size_t event = ready.back();
    ready.pop_back();
    for (const std::size_t next : after[event]) {
      if (--open[next] == 0) ready.push_back(next);
    }
  }
  for (std::uint32_t v = 0; v < plan_.missions.size(); ++v) {
    for (std::uint32_t k = 0; k <= last(v); ++k) {
      if (open[enter(v, k)] != 0) return PolygonRef{v, k};
    }
  }
  for (std::uint32_t v = 0; v < plan_.missions.size(); ++v) {
    if (open[arrived(v)] != 0) return PolygonRef{v, static_cast<std::uint32_t>(last(v))};
  }
  return std::nullopt;
}

}  // namespace stepwright::fleet
