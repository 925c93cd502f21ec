#include "supervisor/fleet/program/interlocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "supervisor/fleet/program/event_order.h"

namespace stepwright::fleet {
namespace {

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
  const auto there = [&](PolygonRef at) {
    return at.vehicle < plan.missions.size() && at.polygon < plan.missions[at.vehicle].grown.visits.size();
  };
  for (const TemporalConstraint& bound : plan.constraints) {
    if (there(bound.to.at) && (!bound.from || there(bound.from->at))) continue;
    return result::fail("F1101", {},
                        fmt::format("the constraint '{}' names a polygon that is not there", bound.name));
  }
  for (const Precedence& wait : plan.schedule.precedences) {
    for (const PolygonRef at : {wait.first, wait.second}) {
      if (!there(at)) {
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

// Waits that would close a circle are left out: their constraints are not seen to.
void keep_waits_that_end(const FleetPlan& plan, Interlocks& made) {
  EventOrder order(plan, made);
  std::vector<TimeWait> kept;
  for (const TimeWait& wait : made.times.waits) {
    order.require(wait, made.times.events);
    if (wait.event && order.blocked()) {
      order.take_back();
      made.times.open.push_back(wait.constraint);
    } else {
      kept.push_back(wait);
    }
  }
  made.times.waits = std::move(kept);
}

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
  for (const VehicleMission& mission : plan.missions)
    made.places.push_back(wait_places(mission, options.margins));
  if (auto good = check_pairs(plan, made); !good) return result::forward(good);
  const EventOrder order(plan, made);
  if (const auto at = order.blocked()) {
    return result::fail(
        "F1103", {},
        fmt::format("'{}' could never enter its polygon {}: the vehicle that it waits for would wait for it",
                    plan.missions[at->vehicle].vehicle, at->polygon),
        "plan with the times of set_driving_times, which tell where vehicles can wait");
  }
  made.times = time_rules(plan);
  keep_waits_that_end(plan, made);
  return made;
}

}  // namespace stepwright::fleet
