#include "tests/bench/shift/what_if.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "tests/bench/shift/dispatcher.h"

namespace stepwright::bench::shift {

namespace {

using std::chrono::milliseconds;

milliseconds whole(double s) {
  return milliseconds(static_cast<milliseconds::rep>(std::llround(1e3 * s)));
}
double seconds(milliseconds time) {
  return std::chrono::duration<double>(time).count();
}

// From event to event: a transport comes in, or a vehicle has stood at a stop for long enough.
class TimedShift {
 public:
  TimedShift(const Scenario& scenario, Fleet& fleet, fleet::Traffic traffic, std::uint32_t vehicles)
      : scenario_(scenario),
        traffic_(std::move(traffic)),
        dispatcher_(scenario, traffic_, fleet.planner(), rule_, figures_),
        next_(vehicles) {
    dispatcher_.only_standing();
    figures_.spent.resize(vehicles);
  }

  ShiftFigures run() {
    const double begin_s = cpu_s();
    const milliseconds end = whole(scenario_.end_s());
    milliseconds now{0};
    while (now < end) {
      traffic_.keep_times(now);
      for (std::uint32_t v = 0; v < next_.size(); ++v) leave_stops(v, now);
      while (transport_ < scenario_.transports.size() &&
             whole(scenario_.transports[transport_].release_s) <= now)
        dispatcher_.release(static_cast<std::uint32_t>(transport_++));
      dispatcher_.dispatch(now);
      for (const std::uint32_t v : dispatcher_.take_rerouted()) next_[v] = stops_ahead(v);
      now = std::min(end, after(now));
    }
    figures_.simulated_s = scenario_.end_s();
    figures_.cpu_s = cpu_s() - begin_s;
    return std::move(figures_);
  }

 private:
  // A stop still ahead: how much of the way is behind the vehicle when it has stood there.
  struct Ahead {
    double arc_m;
    std::string name;
  };

  std::vector<Ahead> stops_ahead(std::uint32_t vehicle) const {
    std::vector<Ahead> stops;
    for (const fleet::Stop& stop : traffic_.route(vehicle).mission.stops) {
      const std::string name = stop.goal + (stop.kind == fleet::StopKind::SetDown ? " set down" : " pick up");
      if (stop.kind != fleet::StopKind::Park && !stood_.contains(name)) stops.push_back({stop.arc_m, name});
    }
    return stops;
  }

  void leave_stops(std::uint32_t vehicle, milliseconds now) {
    figures_.spent[vehicle].busy_s += dispatcher_.busy(vehicle) ? seconds(now - before_) : 0.0;
    auto& stops = next_[vehicle];
    while (!stops.empty() && traffic_.expected(vehicle, stops.front().arc_m) <= now) {
      dispatcher_.stood(vehicle, seconds(now));
      stood_.insert(stops.front().name);
      stops.erase(stops.begin());
    }
    if (vehicle + 1 == next_.size()) before_ = now;
  }

  milliseconds after(milliseconds now) const {
    milliseconds next = now + std::chrono::seconds(20);
    if (transport_ < scenario_.transports.size())
      next = std::min(next, whole(scenario_.transports[transport_].release_s));
    for (std::uint32_t v = 0; v < next_.size(); ++v) {
      if (!next_[v].empty()) next = std::min(next, traffic_.expected(v, next_[v].front().arc_m));
    }
    return std::max(next, now + milliseconds(50));
  }

  const Scenario& scenario_;
  fleet::Traffic traffic_;
  ShiftFigures figures_;
  EarliestDueNearestVehicle rule_;
  Dispatcher dispatcher_;
  std::vector<std::vector<Ahead>> next_;  // by vehicle
  std::set<std::string> stood_;
  std::size_t transport_ = 0;
  milliseconds before_{0};
};

}  // namespace

ShiftFigures run_timed(const Scenario& scenario, Fleet& fleet, std::uint32_t vehicles) {
  auto traffic = fleet::Traffic::create(resting(fleet.planner(), vehicles), {}, milliseconds(0));
  return TimedShift(scenario, fleet, std::move(traffic.value()), vehicles).run();
}

}  // namespace stepwright::bench::shift
