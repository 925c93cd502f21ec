#include "supervisor/fleet/program/time_rules.h"

#include <algorithm>

namespace stepwright::fleet {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kHorizon{100'000'000};

class Maker {
 public:
  explicit Maker(const FleetPlan& plan) : plan_(plan) {}

  TimeRules make() {
    for (std::uint32_t c = 0; c < plan_.constraints.size(); ++c) {
      const TemporalConstraint& bound = plan_.constraints[c];
      if (bound.distance.least > -kHorizon) add_least(bound.from, bound.to, bound.distance.least, c);
      if (bound.distance.most < kHorizon) add_most(bound, c);
    }
    return std::move(made_);
  }

 private:
  const VehicleMission& mission(PolygonRef at) const { return plan_.missions[at.vehicle]; }
  bool last(PolygonRef at) const { return at.polygon + 1 == mission(at).grown.visits.size(); }

  std::uint32_t number_of(const MissionEvent& event) {
    const auto known = std::ranges::find(made_.events, event);
    if (known != made_.events.end()) return static_cast<std::uint32_t>(known - made_.events.begin());
    made_.events.push_back(event);
    return static_cast<std::uint32_t>(made_.events.size() - 1);
  }

  std::uint32_t event_of(const TimepointRef& when) {
    const PolygonRef at = when.at;
    if (when.side == Side::Entry && at.polygon == 0) return number_of({EventKind::Begun, at.vehicle, 0});
    if (when.side == Side::Entry) {
      // A second polygon may begin where the mission does.
      static_cast<void>(number_of({EventKind::Begun, at.vehicle, 0}));
      return number_of({EventKind::Entered, at.vehicle, at.polygon});
    }
    if (const auto stop = stop_of(mission(at), at.polygon))
      return number_of({EventKind::StopDone, at.vehicle, *stop});
    if (last(at)) return number_of({EventKind::Arrived, at.vehicle, 0});
    return number_of({EventKind::Left, at.vehicle, at.polygon});
  }

  // t(to) >= t(from) + least
  void add_least(const std::optional<TimepointRef>& from, const TimepointRef& to, milliseconds least,
                 std::uint32_t constraint) {
    if (!from && least.count() <= 0) return;
    if (least.count() >= 0) {
      add_wait(from, to, least, constraint);
      return;
    }
    // The stop in that polygon can wait although the vehicle is there already.
    if (to.side == Side::Entry) {
      if (const auto stop = stop_of(mission(to.at), to.at.polygon)) {
        const Stop& at = mission(to.at).stops[*stop];
        const double inside_m = at.arc_m - mission(to.at).grown.visits[to.at.polygon].entry_m;
        const milliseconds there = least + time_bounds(std::max(0.0, inside_m), mission(to.at).speed).least;
        if (there.count() >= 0) {
          made_.waits.push_back(
              {ChartPlace::StopBegin, to.at.vehicle, *stop, event_of(*from), there, constraint});
          return;
        }
      }
    }
    made_.limits.push_back({event_of(to), event_of(*from), -least, constraint});
  }

  void add_wait(const std::optional<TimepointRef>& from, const TimepointRef& to, milliseconds delay,
                std::uint32_t constraint) {
    TimeWait wait{.vehicle = to.at.vehicle, .delay = delay, .constraint = constraint};
    if (from) wait.event = event_of(*from);
    const auto stop = stop_of(mission(to.at), to.at.polygon);
    if (to.side == Side::Entry) {
      wait.place = to.at.polygon == 0 ? ChartPlace::Start : ChartPlace::Polygon;
      wait.index = to.at.polygon;
    } else if (stop) {
      wait.place = ChartPlace::StopEnd;
      wait.index = *stop;
    } else if (last(to.at)) {
      wait.place = ChartPlace::End;
    } else {
      // It leaves a polygon behind the entry of the next one.
      wait.place = ChartPlace::Polygon;
      wait.index = to.at.polygon + 1;
    }
    made_.waits.push_back(wait);
  }

  // t(to) <= t(from) + most
  void add_most(const TemporalConstraint& bound, std::uint32_t constraint) {
    const milliseconds most = bound.distance.most;
    if (bound.from && most.count() <= 0) {
      add_least(bound.to, *bound.from, -most, constraint);
      return;
    }
    std::optional<std::uint32_t> since;
    if (bound.from) since = event_of(*bound.from);
    made_.limits.push_back({since, event_of(bound.to), most, constraint});
  }

  const FleetPlan& plan_;
  TimeRules made_;
};

}  // namespace

TimeRules time_rules(const FleetPlan& plan) {
  return Maker(plan).make();
}

std::optional<std::uint32_t> stop_of(const VehicleMission& mission, std::uint32_t polygon) {
  const auto& stands = mission.grown.stands;
  if (stands.size() != mission.stops.size()) return std::nullopt;
  std::optional<std::uint32_t> found;
  for (std::uint32_t k = 0; k < stands.size(); ++k) {
    if (stands[k] == polygon) found = k;
  }
  return found;
}

}  // namespace stepwright::fleet
