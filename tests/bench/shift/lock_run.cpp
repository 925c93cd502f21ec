#include <algorithm>
#include <array>
#include <optional>

#include "tests/bench/shift/dispatcher.h"
#include "tests/bench/shift/what_if.h"

namespace stepwright::bench::shift {

namespace {

constexpr double kTick_s = 0.5;
constexpr double kCarried_s = 600.0;  // somebody has to come and drive it home

struct Locker {
  fleet::Route route;
  std::uint32_t first = 0;
  std::uint32_t granted = 1;
  double clock_s = 0.0;  // of its pace
  std::optional<std::uint32_t> job;
  std::optional<std::uint32_t> waits_for;
  double away_until_s = 0.0;
  bool picked = false;
};

class LockShift {
 public:
  LockShift(const Scenario& scenario, Fleet& fleet, std::uint32_t vehicles)
      : scenario_(scenario), planner_(fleet.planner()), lockers_(vehicles) {
    made_.figures.deliveries.resize(scenario.transports.size());
    made_.figures.spent.resize(vehicles);
    for (std::uint32_t v = 0; v < vehicles; ++v)
      lockers_[v].route = planner_.stand(v, planner_.home(v)).value();
  }

  LockFigures run() {
    for (double now_s = 0.0; now_s < scenario_.end_s(); now_s += kTick_s) {
      while (transport_ < scenario_.transports.size() && scenario_.transports[transport_].release_s <= now_s)
        open_.push_back(static_cast<std::uint32_t>(transport_++));
      for (std::uint32_t k = 0; k < lockers_.size(); ++k) move(k, now_s);
      find_circles(now_s);
      dispatch(now_s);
    }
    made_.figures.simulated_s = scenario_.end_s();
    return std::move(made_);
  }

 private:
  void move(std::uint32_t v, double now_s) {
    Locker& own = lockers_[v];
    if (own.away_until_s > now_s) return;
    own.waits_for.reset();
    const fleet::Route& route = own.route;
    double clock_s = own.clock_s + kTick_s;
    while (own.granted < route.polygons() && clock_s >= route.needed_s[own.granted]) {
      std::uint32_t behind = own.granted + 1;
      while (behind < route.polygons() && route.needed_m[behind] == route.needed_m[own.granted]) ++behind;
      for (std::uint32_t k = own.granted; k < behind && !own.waits_for; ++k) own.waits_for = holder(v, k);
      if (own.waits_for) {
        clock_s = std::max(own.clock_s, route.needed_s[own.granted]);
        break;
      }
      own.granted = behind;
    }
    made_.figures.spent[v].waiting_s += own.waits_for ? kTick_s : 0.0;
    made_.figures.spent[v].busy_s += own.job ? kTick_s : 0.0;
    own.clock_s = clock_s;
    // The vehicle stands a little before what it may not enter: the polygon before that is the only one it is
    // in.
    while (own.first + 1 < own.granted && (clock_s >= route.left_s[own.first] || own.waits_for)) ++own.first;
    deliver(v, now_s);
  }

  std::optional<std::uint32_t> holder(std::uint32_t v, std::uint32_t polygon) const {
    const geometry::ConvexPolygon& wanted = lockers_[v].route.mission.grown.envelope.polygons[polygon].area;
    for (std::uint32_t u = 0; u < lockers_.size(); ++u) {
      if (u == v) continue;
      const Locker& other = lockers_[u];
      for (std::uint32_t k = other.first; k < other.granted; ++k)
        if (overlaps(wanted, other.route.mission.grown.envelope.polygons[k].area)) return u;
    }
    return std::nullopt;
  }

  void deliver(std::uint32_t v, double now_s) {
    Locker& own = lockers_[v];
    if (!own.job) return;
    for (const fleet::Stop& stop : own.route.mission.stops) {
      if (stop.kind == fleet::StopKind::Park || own.clock_s < own.route.pace.time_s(stop.arc_m, true))
        continue;
      Delivery& delivery = made_.figures.deliveries[*own.job];
      if (stop.kind == fleet::StopKind::PickUp) own.picked = true;
      if (stop.kind == fleet::StopKind::SetDown && own.picked) {
        delivery.delivered_s = now_s;
        own.job.reset();
        return;
      }
    }
  }

  void find_circles(double now_s) {
    for (std::uint32_t v = 0; v < lockers_.size(); ++v) {
      std::uint32_t at = v;
      std::size_t steps = 0;
      for (; steps <= lockers_.size() && lockers_[at].waits_for; ++steps) at = *lockers_[at].waits_for;
      if (steps <= lockers_.size()) continue;
      // `at` is within the circle.
      ++made_.deadlocks;
      Locker& carried = lockers_[at];
      if (carried.job) open_.push_back(*carried.job);
      carried = Locker{};
      carried.route = planner_.stand(at, planner_.home(at)).value();
      carried.away_until_s = now_s + kCarried_s;
      return;
    }
  }

  void dispatch(double now_s) {
    if (open_.empty()) return;
    std::vector<FreeVehicle> free;
    for (std::uint32_t v = 0; v < lockers_.size(); ++v) {
      const Locker& own = lockers_[v];
      const bool at_rest = own.first + 1 == own.route.polygons() && own.clock_s >= own.route.left_s.back();
      if (!own.job && own.away_until_s <= now_s && at_rest)
        free.push_back({v, own.route.mission.path.back().pose});
    }
    std::vector<Waiting> waiting;
    for (const std::uint32_t t : open_)
      waiting.push_back({t, scenario_.transports[t].due_s, scenario_.stations[scenario_.transports[t].from]});
    for (const DispatchRule::Choice& choice : rule_.choose(waiting, free)) {
      const Transport& t = scenario_.transports[choice.transport];
      std::array<fleet::Waypoint, 3> stops;
      stops[0].pose = scenario_.stations[t.from];
      stops[0].stop.kind = fleet::StopKind::PickUp;
      stops[1].pose = scenario_.stations[t.to];
      stops[1].stop.kind = fleet::StopKind::SetDown;
      for (int k = 0; k < 2; ++k)
        stops[static_cast<std::size_t>(k)].stop.service =
            std::chrono::milliseconds(static_cast<int>(1e3 * kService_s));
      stops[2].pose = planner_.home(choice.vehicle);
      auto route = planner_.plan(choice.vehicle, planner_.home(choice.vehicle), stops);
      if (!route) continue;
      Locker& own = lockers_[choice.vehicle];
      own = Locker{};
      own.route = *std::move(route);
      own.job = choice.transport;
      made_.figures.deliveries[choice.transport].assigned_s = now_s;
      std::erase(open_, choice.transport);
    }
  }

  const Scenario& scenario_;
  fleet::RoutePlanner& planner_;
  EarliestDueNearestVehicle rule_;
  std::vector<Locker> lockers_;
  std::vector<std::uint32_t> open_;
  std::size_t transport_ = 0;
  LockFigures made_;
};

}  // namespace

LockFigures run_with_locks(const Scenario& scenario, Fleet& fleet, std::uint32_t vehicles) {
  return LockShift(scenario, fleet, vehicles).run();
}

}  // namespace stepwright::bench::shift
