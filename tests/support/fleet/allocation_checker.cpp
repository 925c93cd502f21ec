#include "tests/support/fleet/allocation_checker.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "supervisor/fleet/network/constraint.h"

namespace stepwright::fleet {

namespace {

using std::chrono::milliseconds;

// A pick-up and the set-down that belongs to it.
struct MadeTrip {
  std::uint32_t vehicle = 0;
  RouteStop pick_up;
  RouteStop set_down;
  std::size_t pick_up_at = 0;  // position in the route
  std::size_t set_down_at = 0;
};

class Checker {
 public:
  Checker(const AllocationAnswer& answer, const AllocationProblem& problem)
      : answer_(answer), problem_(problem), trips_(problem.transports.size()) {}

  std::vector<std::string> run() {
    if (answer_.routes.size() != problem_.vehicles.size()) {
      fault("there is not one route for each vehicle");
      return faults_;
    }
    for (std::uint32_t v = 0; v < answer_.routes.size(); ++v) {
      check_loads(v);
      check_times(v);
    }
    for (std::uint32_t t = 0; t < trips_.size(); ++t) check_transport(t);
    for (const TransportConstraint& constraint : problem_.constraints) check_constraint(constraint);
    for (const FixedOrder& order : problem_.orders) check_order(order);
    for (const FixedRoute& route : problem_.routes) check_route(route);
    check_objective();
    return faults_;
  }

 private:
  void fault(std::string text) { faults_.push_back(std::move(text)); }
  void expect(bool holds, const std::string& text) {
    if (!holds) fault(text);
  }

  void check_loads(std::uint32_t v) {
    const std::string& name = problem_.vehicles[v].name;
    std::vector<MadeTrip> open;
    std::uint32_t aboard = 0;
    const auto& stops = answer_.routes[v].stops;
    for (std::size_t at = 0; at < stops.size(); ++at) {
      const RouteStop& stop = stops[at];
      const Transport& transport = problem_.transports[stop.transport.value];
      if (stop.action == LoadAction::PickUp) {
        expect(stop.location == transport.from, name + " picks up where the load is not");
        expect(stop.amount > 0, name + " picks up nothing");
        aboard += stop.amount;
        open.push_back({v, stop, {}, at, 0});
      } else {
        expect(stop.location == transport.to, name + " sets down where the load does not belong");
        const auto trip = std::ranges::find_if(open, [&](const MadeTrip& made) {
          return made.pick_up.transport == stop.transport && made.pick_up.amount == stop.amount;
        });
        if (trip == open.end()) {
          fault(name + " sets down what it has not picked up");
          continue;
        }
        aboard -= stop.amount;
        trip->set_down = stop;
        trip->set_down_at = at;
        trips_[stop.transport.value].push_back(*trip);
        open.erase(trip);
      }
      expect(aboard == stop.aboard, name + " has another amount aboard than is said");
      expect(aboard <= problem_.vehicles[v].capacity, name + " is overloaded");
    }
    expect(open.empty(), name + " keeps a load");
  }

  void check_times(std::uint32_t v) {
    const TransportVehicle& vehicle = problem_.vehicles[v];
    const VehicleRoute& route = answer_.routes[v];
    const TravelTimes& ways = problem_.classes[vehicle.vehicle_class];
    expect(route.start >= vehicle.available, vehicle.name + " leaves before it is available");
    milliseconds ready = route.start, travel{0};
    LocationId place = vehicle.start;
    const auto drive = [&](LocationId to) {
      const auto way = ways(place, to);
      expect(way.has_value(), vehicle.name + " drives where there is no way");
      travel += way.value_or(milliseconds(0));
      ready += way.value_or(milliseconds(0));
      place = to;
    };
    for (const RouteStop& stop : route.stops) {
      drive(stop.location);
      expect(stop.begin >= ready, vehicle.name + " is there before it can be");
      const Transport& transport = problem_.transports[stop.transport.value];
      const bool up = stop.action == LoadAction::PickUp;
      const milliseconds service = up ? transport.pick_up_service : transport.set_down_service;
      expect(stop.end == stop.begin + service, vehicle.name + " does not stand for the service");
      ready = stop.end;
    }
    if (vehicle.finish) drive(*vehicle.finish);
    expect(route.finish == ready, vehicle.name + " is not ready when it can be");
    expect(route.travel == travel, vehicle.name + " drives for another time than is said");
    travel_ += travel;
    if (vehicle.finish || !route.stops.empty()) makespan_ = std::max(makespan_, route.finish);
  }

  void check_transport(std::uint32_t t) {
    const Transport& transport = problem_.transports[t];
    std::uint64_t amount = 0;
    milliseconds end{0};
    for (const MadeTrip& trip : trips_[t]) {
      amount += trip.pick_up.amount;
      end = std::max(end, trip.set_down.end);
      expect(!transport.vehicle || transport.vehicle->value == trip.vehicle,
             transport.name + " is taken by another vehicle than the fixed one");
    }
    expect(amount == transport.amount, transport.name + " is not carried as a whole");
    expect(transport.divisible || trips_[t].size() == 1, transport.name + " is divided");
    if (transport.due && end > *transport.due) tardiness_ += transport.weight * (end - *transport.due);
  }

  std::vector<milliseconds> times_of(const TransportTimepoint& t) const {
    if (t.moment == TransportMoment::TimeZero) return {milliseconds(0)};
    if (t.moment == TransportMoment::VehicleStart) return {answer_.routes[t.index].start};
    std::vector<milliseconds> times;
    for (const MadeTrip& trip : trips_[t.index]) {
      times.push_back(t.moment == TransportMoment::TransportStart ? trip.pick_up.begin : trip.set_down.end);
    }
    return times;
  }

  void check_constraint(const TransportConstraint& c) {
    const auto is_trip = [](const TransportTimepoint& t) {
      return t.moment == TransportMoment::TransportStart || t.moment == TransportMoment::TransportEnd;
    };
    const bool same = is_trip(c.from) && is_trip(c.to) && c.from.index == c.to.index;
    const auto from = times_of(c.from), to = times_of(c.to);
    const auto binds = [](milliseconds d) { return d.count() > -kHorizon_ms && d.count() < kHorizon_ms; };
    for (std::size_t i = 0; i < from.size(); ++i) {
      for (std::size_t j = 0; j < to.size(); ++j) {
        if (same && i != j) continue;
        const milliseconds d = to[j] - from[i];
        expect(!binds(c.distance.least) || d >= c.distance.least, c.name + ": too early");
        expect(!binds(c.distance.most) || d <= c.distance.most, c.name + ": too late");
      }
    }
  }

  void check_order(const FixedOrder& order) {
    for (const MadeTrip& before : trips_[order.before.value]) {
      for (const MadeTrip& after : trips_[order.after.value]) {
        expect(before.vehicle == after.vehicle && before.set_down_at < after.pick_up_at,
               "a fixed order is not kept");
      }
    }
  }

  void check_route(const FixedRoute& route) {
    const auto& stops = answer_.routes[route.vehicle.value].stops;
    bool kept = route.whole ? stops.size() == route.stops.size() : stops.size() >= route.stops.size();
    for (std::size_t i = 0; kept && i < route.stops.size(); ++i) {
      const FixedStop& fixed = route.stops[i];
      kept = stops[i].action == fixed.action && stops[i].transport == fixed.transport &&
             stops[i].amount == fixed.amount;
    }
    expect(kept, "a fixed route is not kept");
  }

  void check_objective() {
    const AllocationObjective& weights = problem_.objective;
    expect(answer_.makespan == makespan_, "the makespan is not what is said");
    expect(answer_.travel == travel_, "the travel is not what is said");
    expect(answer_.tardiness == tardiness_, "the tardiness is not what is said");
    const std::int64_t value = weights.makespan * makespan_.count() + weights.travel * travel_.count() +
                               weights.tardiness * tardiness_.count();
    expect(answer_.objective == value, "the objective is not what is said");
    expect(answer_.lower_bound <= answer_.objective, "the bound is above the objective");
    expect(answer_.verdict != AllocationVerdict::Optimal || answer_.lower_bound == answer_.objective,
           "optimal, but the bound is lower");
  }

  const AllocationAnswer& answer_;
  const AllocationProblem& problem_;
  std::vector<std::vector<MadeTrip>> trips_;  // by transport
  std::vector<std::string> faults_;
  milliseconds makespan_{0};
  milliseconds travel_{0};
  milliseconds tardiness_{0};
};

}  // namespace

std::vector<std::string> faults_of(const AllocationAnswer& answer, const AllocationProblem& problem) {
  return Checker(answer, problem).run();
}

}  // namespace stepwright::fleet
