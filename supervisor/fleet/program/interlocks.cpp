#include "supervisor/fleet/program/interlocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>

namespace stepwright::fleet {
namespace {

// How near a vehicle surely comes to where it halts.
constexpr double kReached_m = 0.1;

// The vehicle's data, its path and its stops, as far as the tables are made of them.
result::Result<void> check_mission(const VehicleMission& mission, std::size_t index) {
  const std::string prefix = fmt::format("missions[{}].", index);
  result::Diagnostics problems = check(mission.model, {}, prefix + "model.");
  for (result::Diagnostic& each : check(mission.speed, {}, prefix + "speed."))
    problems.push_back(std::move(each));
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  for (std::size_t k = 1; k < mission.path.size(); ++k) {
    if (mission.path[k].arc_m >= mission.path[k - 1].arc_m) continue;
    return result::fail("F1101", {}, fmt::format("the way of '{}' falls at pose {}", mission.vehicle, k));
  }
  double behind_m = 0.0;
  for (std::size_t k = 0; k < mission.stops.size(); ++k) {
    const double arc_m = mission.stops[k].arc_m;
    if (!(arc_m >= behind_m && arc_m <= mission.path.back().arc_m)) {
      return result::fail("F1101", {},
                          fmt::format("stop {} of '{}' is at {} m of its way", k, mission.vehicle, arc_m),
                          "stops lie on the path, in the order of the way");
    }
    behind_m = arc_m;
  }
  return {};
}

// Of each vehicle: where it halts before its polygons, and where it has left them.
void find_places(const FleetPlan& plan, const FleetMargins& margins, Interlocks& out) {
  for (const VehicleMission& mission : plan.missions) {
    const auto& visits = mission.grown.visits;
    std::vector<double> halt;
    for (const Visit& visit : visits) halt.push_back(visit.entry_m - margins.halt_before_m);
    std::vector<double> free;
    for (std::size_t k = 0; k < visits.size(); ++k) {
      double at = visits[k].exit_m + margins.left_behind_m;
      if (k + 2 < visits.size()) at = std::min(at, halt[k + 2] - kReached_m);
      if (k + 1 < visits.size()) at = std::max(at, visits[k + 1].entry_m + margins.left_behind_m);
      free.push_back(at);
    }
    out.halt_m.push_back(std::move(halt));
    out.free_m.push_back(std::move(free));
  }
}

result::Result<void> check_parts(const FleetPlan& plan) {
  if (plan.schedule.verdict != Verdict::Scheduled) {
    return result::fail("F1101", {}, "the plan has no schedule", "only a plan that is scheduled can be run");
  }
  for (const VehicleMission& mission : plan.missions) {
    const std::size_t polygons = mission.grown.envelope.polygons.size();
    if (polygons == 0 || polygons != mission.grown.visits.size() || mission.path.empty()) {
      return result::fail("F1101", {},
                          fmt::format("vehicle '{}' has {} polygons, {} visits and {} poses", mission.vehicle,
                                      polygons, mission.grown.visits.size(), mission.path.size()),
                          "each vehicle has a path, and a visit for each of its polygons");
    }
    const auto index = static_cast<std::size_t>(&mission - plan.missions.data());
    if (auto good = check_mission(mission, index); !good) return good;
  }
  for (const Precedence& wait : plan.schedule.precedences) {
    for (const PolygonRef at : {wait.first, wait.second}) {
      const bool there =
          at.vehicle < plan.missions.size() && at.polygon < plan.missions[at.vehicle].grown.visits.size();
      if (!there) {
        return result::fail(
            "F1101", {},
            fmt::format("a precedence names polygon {} of vehicle number {}, which is not there", at.polygon,
                        at.vehicle));
      }
    }
  }
  return {};
}

// True if the interlocks let `second` enter only after `first` has been left.
bool ordered(const Interlocks& made, PolygonRef first, PolygonRef second) {
  const auto& before = made.before[second.vehicle];
  for (std::uint32_t k = 0; k <= second.polygon; ++k) {
    for (const Interlock& wait : before[k]) {
      if (wait.vehicle == first.vehicle && wait.polygon >= first.polygon) return true;
    }
  }
  return false;
}

result::Result<void> check_pairs(const FleetPlan& plan, const Interlocks& made) {
  const auto envelopes = envelopes_of(plan);
  for (const SpatialPair& pair : overlapping_pairs(envelopes)) {
    if (ordered(made, pair.a, pair.b) || ordered(made, pair.b, pair.a)) continue;
    return result::fail(
        "F1102", {},
        fmt::format(
            "polygon {} of '{}' and polygon {} of '{}' overlap, and no precedence says who comes first",
            pair.a.polygon, envelopes[pair.a.vehicle].vehicle, pair.b.polygon,
            envelopes[pair.b.vehicle].vehicle),
        "a program needs a schedule of Mode::Strict");
  }
  return {};
}

// Entering and leaving of polygons as events, each with the events that must have come before.
class Events {
 public:
  Events(const FleetPlan& plan, const Interlocks& made) : plan_(plan), made_(made) {
    for (const VehicleMission& mission : plan.missions) {
      first_.push_back(count_);
      count_ += 2 * mission.grown.visits.size();
    }
    after_.resize(count_);
    open_.resize(count_, 0);
    for (std::uint32_t v = 0; v < plan.missions.size(); ++v) add_vehicle(v);
  }

  // The first event, vehicle by vehicle, that never comes.
  std::optional<PolygonRef> blocked() {
    std::vector<std::size_t> ready;
    for (std::size_t event = 0; event < count_; ++event) {
      if (open_[event] == 0) ready.push_back(event);
    }
    while (!ready.empty()) {
      const std::size_t event = ready.back();
      ready.pop_back();
      for (const std::size_t next : after_[event]) {
        if (--open_[next] == 0) ready.push_back(next);
      }
    }
    for (std::uint32_t v = 0; v < plan_.missions.size(); ++v) {
      for (std::uint32_t k = 0; k < plan_.missions[v].grown.visits.size(); ++k) {
        if (open_[enter(v, k)] != 0) return PolygonRef{v, k};
      }
    }
    return std::nullopt;
  }

 private:
  std::size_t enter(std::uint32_t v, std::size_t k) const { return first_[v] + 2 * k; }
  std::size_t leave(std::uint32_t v, std::size_t k) const { return first_[v] + 2 * k + 1; }
  void require(std::size_t event, std::size_t before) {
    after_[before].push_back(event);
    ++open_[event];
  }

  void add_vehicle(std::uint32_t v) {
    const std::size_t polygons = plan_.missions[v].grown.visits.size();
    for (std::size_t k = 0; k < polygons; ++k) {
      if (k > 0) require(enter(v, k), enter(v, k - 1));
      for (const Interlock& wait : made_.before[v][k]) {
        require(enter(v, k), leave(wait.vehicle, wait.polygon));
      }
      // To come so far it has to have entered all polygons before which it would halt short of it.
      std::size_t needed = k + 1;
      while (needed + 1 < polygons && made_.halt_m[v][needed + 1] < made_.free_m[v][k] + 0.5 * kReached_m)
        ++needed;
      if (k + 1 < polygons) {
        require(leave(v, k), enter(v, needed));
      } else {
        require(leave(v, k), leave(v, k));  // nobody leaves its last polygon
      }
    }
  }

  const FleetPlan& plan_;
  const Interlocks& made_;
  std::vector<std::size_t> first_;
  std::size_t count_ = 0;
  std::vector<std::vector<std::size_t>> after_;
  std::vector<std::size_t> open_;
};

}  // namespace

result::Result<Interlocks> find_interlocks(const FleetPlan& plan, const ProgramOptions& options) {
  if (auto good = check_parts(plan); !good) return result::forward(good);
  Interlocks made;
  for (const VehicleMission& mission : plan.missions) made.before.emplace_back(mission.grown.visits.size());
  for (const Precedence& wait : plan.schedule.precedences) {
    made.before[wait.second.vehicle][wait.second.polygon].push_back({wait.first.vehicle, wait.first.polygon});
  }
  for (auto& vehicle : made.before) {
    for (auto& waits : vehicle) std::ranges::sort(waits);
  }
  find_places(plan, options.margins, made);
  if (auto good = check_pairs(plan, made); !good) return result::forward(good);
  Events events(plan, made);
  if (const auto at = events.blocked()) {
    return result::fail(
        "F1103", {},
        fmt::format("'{}' could never enter its polygon {}: the vehicle that it waits for would wait for it",
                    plan.missions[at->vehicle].vehicle, at->polygon),
        "polygons that a vehicle has to wait between need a way of 0.5 m from entry to entry");
  }
  return made;
}

}  // namespace stepwright::fleet
