#pragma once

// Order of events, and the check that all that vehicles wait for can come: entering and leaving of polygons
// and the end of stops as events, each with the events that must have come before it. Not for several
// threads.
//
//   EventOrder order(plan, interlocks);
//   order.require(wait, rules.events);
//   if (const auto at = order.blocked()) ...   // the first polygon that is never entered

#include <optional>
#include <vector>

#include "supervisor/fleet/program/interlocks.h"

namespace stepwright::fleet {

class EventOrder {
 public:
  // The order by the ways and `made.before`. All outlive it.
  EventOrder(const FleetPlan& plan, const Interlocks& made);

  // Adds the order of a wait. It may be taken back if nothing was added since.
  void require(const TimeWait& wait, const std::vector<MissionEvent>& events);
  void take_back();

  // The first entry, vehicle by vehicle, that never comes; the last polygon of who never arrives.
  std::optional<PolygonRef> blocked() const;

 private:
  struct Edge {
    std::size_t before;
    std::size_t event;
  };

  std::size_t enter(std::uint32_t v, std::size_t k) const { return first_[v] + 2 * k; }
  std::size_t leave(std::uint32_t v, std::size_t k) const { return first_[v] + 2 * k + 1; }
  std::size_t stop_done(std::uint32_t v, std::size_t k) const { return leave(v, last(v)) + 1 + k; }
  std::size_t arrived(std::uint32_t v) const { return stop_done(v, plan_.missions[v].stops.size()); }
  std::size_t last(std::uint32_t v) const { return plan_.missions[v].grown.visits.size() - 1; }
  std::size_t event_of(const MissionEvent& event) const;
  std::size_t event_of(const TimeWait& wait) const;
  void require(std::size_t event, std::size_t before) { edges_.push_back({before, event}); }
  void add_vehicle(std::uint32_t v);
  void add_stops(std::uint32_t v);

  const FleetPlan& plan_;
  const Interlocks& made_;
  std::vector<std::size_t> first_;  // event by vehicle
  std::size_t count_ = 0;
  std::vector<Edge> edges_;
};

}  // namespace stepwright::fleet
