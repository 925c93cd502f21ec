#include "supervisor/fleet/allocation/internal/trip_model.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "supervisor/fleet/network/network.h"

namespace stepwright::fleet::internal {

namespace {

// Floyd and Warshall; out of reach stays kNoWay.
std::vector<std::int32_t> closed(std::vector<std::int32_t> ways, std::size_t places) {
  for (std::size_t k = 0; k < places; ++k) {
    const std::int32_t* const through = &ways[k * places];
    for (std::size_t i = 0; i < places; ++i) {
      const std::int32_t first = ways[i * places + k];
      if (first >= kNoWay) continue;
      std::int32_t* const row = &ways[i * places];
      for (std::size_t j = 0; j < places; ++j) row[j] = std::min(row[j], first + through[j]);
    }
  }
  return ways;
}

std::int32_t whole_ms(std::chrono::milliseconds time) {
  assert(time.count() >= 0 && time.count() <= kHorizon_ms);
  return static_cast<std::int32_t>(time.count());
}

}  // namespace

class TripModelMaker {
 public:
  TripModelMaker(const AllocationProblem& problem, const Selection& selection, Ways ways)
      : problem_(problem), selection_(selection), kind_(ways) {
    model_.problem_ = &problem;
  }

  TripModel make(const Division& division) {
    add_ways();
    add_drivers();
    for (std::uint32_t r = 0; r < problem_.routes.size(); ++r) {
      if (selection_.routes[r] != 0) add_fixed(problem_.routes[r]);
    }
    check_amounts(division);
    for (std::uint32_t t = 0; t < division.size(); ++t) {
      for (std::size_t i = 0; i < division[t].size(); ++i) {
        const bool alike = i > 0 && division[t][i] == division[t][i - 1];
        add_trip(t, division[t][i], kNone);
        if (alike) model_.trips_.back().alike = model_.trips() - 2;
      }
    }
    add_orders();
    find_places();
    for (const Driver& driver : model_.drivers_) check_fixed(driver);
    for (std::uint32_t t = 0; t < model_.trips(); ++t) settle_vehicles(t);
    find_like_vehicles();
    add_trip_constraints();
    for (std::uint32_t c = 0; c < problem_.constraints.size(); ++c) {
      if (selection_.constraints[c] != 0) add_constraint(problem_.constraints[c]);
    }
    find_windows();
    return std::move(model_);
  }

 private:
  // What is looked at of the locations: those at which a vehicle has ever anything to do.
  std::uint32_t place_of(LocationId location) {
    std::uint32_t& place = places_[location.value];
    if (place == kNone) {
      place = static_cast<std::uint32_t>(model_.places_++);
      locations_.push_back(location);
    }
    return place;
  }

  void add_ways() {
    places_.assign(problem_.locations.size(), kNone);
    for (const TransportVehicle& vehicle : problem_.vehicles) {
      place_of(vehicle.start);
      if (vehicle.finish) place_of(*vehicle.finish);
    }
    for (std::size_t t = 0; t < problem_.transports.size(); ++t) {
      if (selection_.transports[t] == 0) continue;
      place_of(problem_.transports[t].from);
      place_of(problem_.transports[t].to);
    }
    for (const TravelTimes& times : problem_.classes) {
      std::vector<std::int32_t> ways;
      ways.reserve(locations_.size() * locations_.size());
      for (const LocationId from : locations_) {
        for (const LocationId to : locations_) {
          const auto time = times(from, to);
          ways.push_back(time ? whole_ms(*time) : kNoWay);
        }
      }
      model_.least_ways_.push_back(closed(ways, model_.places_));
      model_.ways_.push_back(kind_ == Ways::Closed ? model_.least_ways_.back() : std::move(ways));
    }
  }

  void add_drivers() {
    for (const TransportVehicle& vehicle : problem_.vehicles) {
      Driver driver;
      driver.vehicle_class = vehicle.vehicle_class;
      driver.start = place_of(vehicle.start);
      if (vehicle.finish) driver.finish = place_of(*vehicle.finish);
      driver.capacity = vehicle.capacity;
      driver.available_ms = whole_ms(vehicle.available);
      model_.drivers_.push_back(driver);
    }
  }

  std::uint32_t add_trip(std::uint32_t transport, std::uint32_t amount, std::uint32_t vehicle) {
    Trip trip;
    trip.transport = transport;
    trip.amount = amount;
    trip.vehicles.assign(model_.vehicles(), vehicle == kNone ? 1 : 0);
    if (vehicle != kNone) trip.vehicles[vehicle] = 1;
    model_.trips_.push_back(std::move(trip));
    fixed_.push_back(vehicle != kNone);
    return model_.trips() - 1;
  }

  void add_fixed(const FixedRoute& route) {
    Driver& driver = model_.drivers_[route.vehicle.value];
    driver.whole = route.whole;
    std::vector<std::uint32_t> aboard;
    for (const FixedStop& stop : route.stops) {
      if (selection_.transports[stop.transport.value] == 0) continue;
      if (stop.action == LoadAction::PickUp) {
        aboard.push_back(add_trip(stop.transport.value, stop.amount, route.vehicle.value));
        driver.fixed.push_back(pick_up_of(aboard.back()));
        continue;
      }
      const auto trip = std::ranges::find_if(aboard, [&](std::uint32_t t) {
        return model_.trips_[t].transport == stop.transport.value && model_.trips_[t].amount == stop.amount;
      });
      if (trip == aboard.end()) {
        model_.contradiction_ = true;
        continue;
      }
      driver.fixed.push_back(set_down_of(*trip));
      aboard.erase(trip);
    }
    if (driver.whole && !aboard.empty()) model_.contradiction_ = true;
  }

  // Fixed routes may not take more of a transport than there is, nor a part of what is indivisible.
  void check_amounts(const Division& division) {
    for (std::uint32_t t = 0; t < division.size(); ++t) {
      if (selection_.transports[t] == 0) continue;
      std::uint64_t amount = 0;
      std::size_t parts = division[t].size();
      for (const std::uint32_t part : division[t]) amount += part;
      for (const Trip& trip : model_.trips_) {
        if (trip.transport != t) continue;
        amount += trip.amount;
        ++parts;
      }
      if (amount != problem_.transports[t].amount) model_.contradiction_ = true;
      if (!problem_.transports[t].divisible && parts > 1) model_.contradiction_ = true;
    }
  }

  void add_orders() {
    for (std::uint32_t o = 0; o < problem_.orders.size(); ++o) {
      if (selection_.orders[o] == 0) continue;
      const FixedOrder& order = problem_.orders[o];
      if (order.before == order.after) {
        model_.contradiction_ |= selection_.transports[order.before.value] != 0;
        continue;
      }
      for (std::uint32_t a = 0; a < model_.trips(); ++a) {
        if (model_.trips_[a].transport != order.before.value) continue;
        for (std::uint32_t b = 0; b < model_.trips(); ++b) {
          if (model_.trips_[b].transport != order.after.value) continue;
          model_.trips_[b].predecessors.push_back(a);
          model_.trips_[a].successors.push_back(b);
        }
      }
    }
  }

  // Fixed stops within the capacity; what has to be set down before is, on the same route.
  void check_fixed(const Driver& driver) {
    std::uint64_t load = 0;
    std::vector<char> done(model_.trips(), 0);
    for (const StopIndex stop : driver.fixed) {
      const Trip& trip = model_.trips_[trip_of(stop)];
      if (is_pick_up(stop)) {
        load += trip.amount;
        model_.contradiction_ |= load > driver.capacity;
        for (const std::uint32_t before : trip.predecessors) model_.contradiction_ |= done[before] == 0;
      } else {
        load -= trip.amount;
        done[trip_of(stop)] = 1;
      }
    }
  }

  void find_places() {
    for (std::uint32_t t = 0; t < model_.trips(); ++t) {
      const Transport& transport = model_.transport_of(t);
      model_.place_.push_back(place_of(transport.from));
      model_.place_.push_back(place_of(transport.to));
      model_.service_.push_back(whole_ms(transport.pick_up_service));
      model_.service_.push_back(whole_ms(transport.set_down_service));
    }
  }

  void settle_vehicles(std::uint32_t t) {
    Trip& trip = model_.trips_[t];
    const std::optional<VehicleId>& hand = model_.transport_of(t).vehicle;
    for (std::uint32_t v = 0; v < model_.vehicles(); ++v) {
      const Driver& driver = model_.drivers_[v];
      const bool chosen = !hand || selection_.vehicles[trip.transport] == 0 || hand->value == v;
      const bool room = driver.capacity >= trip.amount && (fixed_[t] != 0 || !driver.whole);
      const std::uint32_t from = model_.place(pick_up_of(t));
      const bool reached = model_.least_way_ms(v, driver.start, from) < kNoWay &&
                           model_.least_way_ms(v, from, model_.place(set_down_of(t))) < kNoWay;
      if (!chosen || !room || !reached) trip.vehicles[v] = 0;
    }
    if (std::ranges::find(trip.vehicles, 1) == trip.vehicles.end()) model_.contradiction_ = true;
  }

  void find_like_vehicles() {
    std::vector<char> named(model_.vehicles(), 0);
    for (std::uint32_t v = 0; v < model_.vehicles(); ++v) {
      const Driver& driver = model_.drivers_[v];
      named[v] = driver.whole || !driver.fixed.empty() ? 1 : 0;
    }
    for (std::uint32_t c = 0; c < problem_.constraints.size(); ++c) {
      if (selection_.constraints[c] == 0) continue;
      for (const TransportTimepoint& end : {problem_.constraints[c].from, problem_.constraints[c].to}) {
        if (end.moment == TransportMoment::VehicleStart) named[end.index] = 1;
      }
    }
    for (std::uint32_t v = 1; v < model_.vehicles(); ++v) {
      const Driver &a = model_.drivers_[v - 1], &b = model_.drivers_[v];
      const bool same_trips = std::ranges::all_of(
          model_.trips_, [v](const Trip& trip) { return trip.vehicles[v] == trip.vehicles[v - 1]; });
      model_.drivers_[v].like_before = named[v - 1] == 0 && named[v] == 0 && same_trips &&
                                       a.vehicle_class == b.vehicle_class && a.start == b.start &&
                                       a.finish == b.finish && a.capacity == b.capacity &&
                                       a.available_ms == b.available_ms;
    }
  }

  void post(Timepoint from, Timepoint to, std::int64_t least_ms) {
    if (least_ms > kHorizon_ms) least_ms = kHorizon_ms + 1;
    if (least_ms < -kHorizon_ms) return;
    model_.constraints_.push_back({from, to, static_cast<std::int32_t>(least_ms), 0});
  }

  void add_trip_constraints() {
    for (std::uint32_t v = 0; v < model_.vehicles(); ++v) {
      post(kOrigin, model_.start_of(v), model_.drivers_[v].available_ms);
    }
    for (std::uint32_t t = 0; t < model_.trips(); ++t) {
      std::int32_t arrival_ms = kNoWay, way_ms = kNoWay;
      const std::uint32_t from = model_.place(pick_up_of(t)), to = model_.place(set_down_of(t));
      for (std::uint32_t v = 0; v < model_.vehicles(); ++v) {
        if (model_.trips_[t].vehicles[v] == 0) continue;
        const Driver& driver = model_.drivers_[v];
        arrival_ms = std::min(arrival_ms, driver.available_ms + model_.least_way_ms(v, driver.start, from));
        way_ms = std::min(way_ms, model_.least_way_ms(v, from, to));
      }
      post(kOrigin, TripModel::at(pick_up_of(t)), arrival_ms);
      post(TripModel::at(pick_up_of(t)), TripModel::at(set_down_of(t)),
           way_ms + model_.service_ms(pick_up_of(t)));
    }
  }

  // A moment of one trip, or of a vehicle: its timepoint and how much later than that it is.
  struct Moment {
    Timepoint at;
    std::int32_t after_ms = 0;
    std::uint32_t trip = kNone;
  };
  std::vector<Moment> moments_of(const TransportTimepoint& timepoint) const {
    if (timepoint.moment == TransportMoment::TimeZero) return {{kOrigin, 0, kNone}};
    if (timepoint.moment == TransportMoment::VehicleStart) {
      return {{model_.start_of(timepoint.index), 0, kNone}};
    }
    std::vector<Moment> moments;
    for (std::uint32_t t = 0; t < model_.trips(); ++t) {
      if (model_.trips_[t].transport != timepoint.index) continue;
      const StopIndex down = set_down_of(t);
      moments.push_back(timepoint.moment == TransportMoment::TransportStart
                            ? Moment{TripModel::at(pick_up_of(t)), 0, t}
                            : Moment{TripModel::at(down), model_.service_ms(down), t});
    }
    return moments;
  }

  void add_constraint(const TransportConstraint& constraint) {
    const auto is_trip = [](const TransportTimepoint& t) {
      return t.moment == TransportMoment::TransportStart || t.moment == TransportMoment::TransportEnd;
    };
    const bool same_transport =
        is_trip(constraint.from) && is_trip(constraint.to) && constraint.from.index == constraint.to.index;
    const bool couples = constraint.from.moment != TransportMoment::TimeZero &&
                         constraint.to.moment != TransportMoment::TimeZero;
    for (const Moment& from : moments_of(constraint.from)) {
      for (const Moment& to : moments_of(constraint.to)) {
        if (same_transport && from.trip != to.trip) continue;
        tie(from, to, constraint.distance);
        for (const std::uint32_t trip : {from.trip, to.trip}) {
          if (!couples || trip == kNone) continue;
          model_.trips_[trip].coupled = true;
          model_.coupled_ = true;
        }
      }
    }
  }

  void tie(const Moment& from, const Moment& to, const TransportConstraint::Distance& distance) {
    const std::int64_t least = distance.least.count(), most = distance.most.count();
    const std::int64_t shift = static_cast<std::int64_t>(from.after_ms) - to.after_ms;
    if (least > -kHorizon_ms && least < kHorizon_ms) post(from.at, to.at, least + shift);
    if (most > -kHorizon_ms && most < kHorizon_ms) post(to.at, from.at, -(most + shift));
  }

  void find_windows() {
    Network network(model_.timepoints());
    if (!network.post(model_.constraints_)) {
      model_.contradiction_ = true;
      return;
    }
    network.track_latest();
    for (StopIndex stop = 0; stop < model_.stops(); ++stop) {
      model_.earliest_.push_back(network.earliest_ms(TripModel::at(stop)));
      model_.latest_.push_back(
          std::min(network.latest_ms(TripModel::at(stop)), kHorizon_ms - model_.service_ms(stop)));
    }
    for (std::uint32_t v = 0; v < model_.vehicles(); ++v) {
      model_.starts_.push_back(network.earliest_ms(model_.start_of(v)));
    }
  }

  const AllocationProblem& problem_;
  const Selection& selection_;
  Ways kind_;
  TripModel model_;
  std::vector<std::uint32_t> places_;  // by location
  std::vector<LocationId> locations_;  // by place
  std::vector<char> fixed_;            // by trip: part of a fixed route
};

TripModel make_model(const AllocationProblem& problem, const Selection& selection, const Division& division,
                     Ways ways) {
  return TripModelMaker(problem, selection, ways).make(division);
}

}  // namespace stepwright::fleet::internal
