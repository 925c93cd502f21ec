#include "supervisor/fleet/mission/explain_schedule.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace stepwright::fleet {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds kNoticed{100};

geometry::Point middle(const FleetPlan& plan, PolygonRef at) {
  return plan.missions[at.vehicle].grown.envelope.polygons[at.polygon].area.centroid();
}

std::string point(geometry::Point at) {
  return fmt::format("({:.1f} m, {:.1f} m)", at.x_m, at.y_m);
}

// What a vehicle does in a polygon that it cannot leave to others; empty if it only drives through.
std::string standing(const FleetPlan& plan, PolygonRef at) {
  const VehicleMission& mission = plan.missions[at.vehicle];
  const bool last = at.polygon + 1 == mission.grown.envelope.polygons.size();
  if (last && at.polygon == 0) return fmt::format("{} stands there all the time", mission.vehicle);
  if (last && !mission.stops.empty()) {
    return fmt::format("{} stays there at '{}'", mission.vehicle, mission.stops.back().location);
  }
  if (last) return fmt::format("{} stays there at its end", mission.vehicle);
  return at.polygon == 0 ? fmt::format("{} stands there at its start", mission.vehicle) : std::string();
}

std::string sentence(const FleetPlan& plan, const std::vector<SpatialPair>& section) {
  const SpatialPair& front = section.front();
  const SpatialPair& back = section.back();
  std::string text = fmt::format("{} and {} meet at {}", plan.missions[front.a.vehicle].vehicle,
                                 plan.missions[front.b.vehicle].vehicle, point(middle(plan, front.a)));
  if (section.size() > 1) text += fmt::format(" to {}", point(middle(plan, back.a)));
  text += ": one of them must come first";
  std::set<std::string> stands;
  for (const SpatialPair& pair : section) {
    stands.insert(standing(plan, pair.a));
    stands.insert(standing(plan, pair.b));
  }
  for (const std::string& stand : stands) {
    if (!stand.empty()) text += "; " + stand;
  }
  return text + "\n";
}

std::string place(const result::Location& where) {
  return where.line == 0 ? std::string() : fmt::format(" ({}:{}:{})", where.file, where.line, where.column);
}

}  // namespace

std::vector<Wait> waits_of(const FleetPlan& plan) {
  std::vector<Wait> waits;
  const Schedule& made = plan.schedule;
  for (const Precedence& order : made.precedences) {
    const auto& times = made.earliest[order.second.vehicle];
    const milliseconds entry = times[order.second.polygon].entry;
    if (entry != made.earliest[order.first.vehicle][order.first.polygon].exit) continue;
    // Without waiting it would have come from the polygon before as fast as it can.
    const auto& polygons = plan.missions[order.second.vehicle].grown.envelope.polygons;
    milliseconds could{0};
    if (order.second.polygon > 0) {
      const auto& before = polygons[order.second.polygon - 1];
      could = times[order.second.polygon - 1].entry +
              std::max(milliseconds(0), before.stay.least - before.overlap.least);
    }
    if (entry - could < kNoticed) continue;
    waits.push_back({.waiting = order.second.vehicle,
                     .first = order.first.vehicle,
                     .polygon = order.second.polygon,
                     .place = middle(plan, order.second),
                     .from = could,
                     .until = entry});
  }
  std::ranges::sort(waits, {}, [](const Wait& wait) { return std::pair(wait.from, wait.waiting); });
  return waits;
}

std::string reason_of(const FleetPlan& plan, const Core& core, const MissionProblem* problem,
                      const std::vector<std::string>& keys) {
  std::string text;
  for (const auto& section : core.sections) text += sentence(plan, section);
  for (const std::uint32_t vehicle : core.slowest) {
    text += fmt::format("{} may not drive slower than {} m/s\n", plan.missions[vehicle].vehicle,
                        plan.missions[vehicle].speed.min_mps);
  }
  for (const std::uint32_t k : core.constraints) {
    const bool known = problem != nullptr && k < keys.size();
    text += fmt::format("constraint '{}'{}\n", plan.constraints[k].name,
                        known ? place(place_of(*problem, keys[k])) : std::string());
  }
  if (core.sections.empty()) {
    std::string who;
    for (const std::uint32_t v : core.vehicles) who += (who.empty() ? "" : ", ") + plan.missions[v].vehicle;
    if (!who.empty()) text += fmt::format("{}: even alone on the floor\n", who);
  }
  return text;
}

}  // namespace stepwright::fleet
