#include "tests/browser/fleet_follower.h"

#include <algorithm>
#include <utility>

#include "supervisor/fleet/mission/explain_schedule.h"
#include "supervisor/fleet/schedule/sections.h"

namespace stepwright::browser {
namespace {

using namespace fleet;
using nlohmann::json;

constexpr double kDegrees = 57.29577951308232;
constexpr double kAtItsEnd_m = 0.5;  // of the way that it may drive

json corners_of(const geometry::ConvexPolygon& area) {
  json corners = json::array();
  for (const geometry::Point p : area.corners()) corners.push_back({p.x_m, p.y_m});
  return corners;
}

json path_of(const FleetPlan& plan, std::size_t v) {
  const VehicleMission& mission = plan.missions[v];
  json poses = json::array();
  for (const auto& at : mission.path) {
    poses.push_back({at.pose.x_m, at.pose.y_m, at.pose.heading_rad * kDegrees});
  }
  json stops = json::array();
  for (std::size_t k = 0; k < mission.stops.size(); ++k) {
    const std::size_t polygon =
        mission.grown.stands.empty() ? mission.grown.visits.size() - 1 : mission.grown.stands[k];
    stops.push_back({{"kind", "park"},
                     {"location", "bay of " + mission.vehicle},
                     {"arc_m", mission.stops[k].arc_m},
                     {"service_ms", mission.stops[k].service.count()},
                     {"polygon", polygon},
                     {"end_ms", plan.schedule.earliest[v][polygon].exit.count()}});
  }
  return {{"vehicle", mission.vehicle},
          {"length_m", mission.path.back().arc_m},
          {"stops", std::move(stops)},
          {"poses_m_m_deg", std::move(poses)}};
}

json polygons_of(const FleetPlan& plan, std::size_t v) {
  json all = json::array();
  const auto& polygons = plan.missions[v].grown.envelope.polygons;
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    const PolygonTimes& times = plan.schedule.earliest[v][k];
    all.push_back({{"corners_m", corners_of(polygons[k].area)},
                   {"earliest_ms", {times.entry.count(), times.exit.count()}}});
  }
  return {{"vehicle", plan.missions[v].vehicle}, {"polygons", std::move(all)}};
}

json sections_of(const FleetPlan& plan) {
  const auto envelopes = envelopes_of(plan);
  const Sections sections = merge_sections(overlapping_pairs(envelopes), envelopes);
  json all = json::array();
  for (const CriticalSection& section : sections.sections) {
    json polygons = json::array();
    json areas = json::array();
    for (const SpatialPair& pair : sections.of(section)) {
      for (const PolygonRef at : {pair.a, pair.b}) {
        polygons.push_back({{"vehicle", plan.missions[at.vehicle].vehicle}, {"polygon", at.polygon}});
      }
      const auto both = intersection(envelopes[pair.a.vehicle].polygons[pair.a.polygon].area,
                                     envelopes[pair.b.vehicle].polygons[pair.b.polygon].area);
      if (both) areas.push_back(corners_of(*both));
    }
    const SpatialPair& head = sections.of(section).front();
    const auto entry = [&](PolygonRef at) { return plan.schedule.earliest[at.vehicle][at.polygon].entry; };
    const bool a_first = entry(head.a) <= entry(head.b);
    all.push_back({{"polygons", std::move(polygons)},
                   {"corners_m", std::move(areas)},
                   {"order",
                    {plan.missions[a_first ? section.a : section.b].vehicle,
                     plan.missions[a_first ? section.b : section.a].vehicle}}});
  }
  return all;
}

json waits_of_plan(const FleetPlan& plan) {
  json all = json::array();
  for (const Wait& wait : waits_of(plan)) {
    all.push_back({{"vehicle", plan.missions[wait.waiting].vehicle},
                   {"for", plan.missions[wait.first].vehicle},
                   {"from_ms", wait.from.count()},
                   {"until_ms", wait.until.count()}});
  }
  return all;
}

}  // namespace

FleetFollower::FleetFollower(const FleetPlan& plan, const FleetProgram& program,
                             std::span<const std::byte> container, std::string digest)
    : plan_(plan), program_(program), info_(reader::ProgramInfo::read(container).value()) {
  json fleet = {{"revision", 1}, {"sections", sections_of(plan)}, {"waits", waits_of_plan(plan)}};
  for (std::size_t v = 0; v < plan.missions.size(); ++v) {
    fleet["paths"].push_back(path_of(plan, v));
    fleet["polygons"].push_back(polygons_of(plan, v));
  }
  document_ = {{"cell", "fleet"},
               {"phase", "executing"},
               {"message", "vehicles are on their way"},
               {"program_digest", std::move(digest)},
               {"incidents", json::array()},
               {"fleet", std::move(fleet)}};
}

double FleetFollower::value(const std::string& name, const dds::Snapshot& snapshot) const {
  const reader::Variable* variable = info_.find(name);
  return variable == nullptr ? 0.0 : reader::read_number(*variable, snapshot.image);
}

std::optional<std::size_t> FleetFollower::waited_for(std::size_t index, const dds::Snapshot& snapshot) const {
  const double left = value("areas_" + program_.missions[index].name, snapshot);
  std::optional<Precedence> next;
  for (const Precedence& order : plan_.schedule.precedences) {
    if (order.second.vehicle != index || order.second.polygon < left) continue;
    const bool behind =
        value("areas_" + program_.missions[order.first.vehicle].name, snapshot) > order.first.polygon;
    if (!behind && (!next || order.second.polygon < next->second.polygon)) next = order;
  }
  if (!next) return std::nullopt;
  return next->first.vehicle;
}

json FleetFollower::vehicle(std::size_t index, const dds::Snapshot& snapshot, double now_ms) const {
  const std::string& v = program_.missions[index].name;
  const auto of = [&](const char* what) { return value(what + v, snapshot); };
  const auto& times = plan_.schedule.earliest[index];
  const auto left = std::min(static_cast<std::size_t>(of("areas_")), times.size() - 1);
  const double delay_ms = std::max(0.0, now_ms - static_cast<double>(times[left].exit.count()));
  const double error = value("vehicle_" + v + ".ErrorID", snapshot);
  const bool done = of("done_") != 0.0;
  json news = {{"vehicle", plan_.missions[index].vehicle},
               {"variable", v},
               {"state", error != 0.0 ? "stopped"
                         : done       ? "resting"
                                      : "driving"},
               {"delay_ms", done ? 0.0 : delay_ms},
               {"arrives_ms", static_cast<double>(times.back().exit.count()) + (done ? 0.0 : delay_ms)},
               {"stops_done", done ? plan_.missions[index].stops.size() : 0},
               {"error", error}};
  const bool halts = of("standing_") != 0.0 && of("arc_") > of("permitted_") - kAtItsEnd_m;
  const auto first = waited_for(index, snapshot);
  if (!done && error == 0.0 && halts && first) {
    news["state"] = "waiting";
    news["waits_for"] = plan_.missions[*first].vehicle;
  }
  return news;
}

std::string FleetFollower::document(const dds::Snapshot& snapshot) {
  const double clock_ms = value("fleet_time", snapshot) * 1e-6;
  json& fleet = document_["fleet"];
  fleet["epoch_s"] = static_cast<double>(snapshot.time_ns) * 1e-9 - clock_ms * 1e-3;
  fleet["vehicles"] = json::array();
  fleet["goals"] = json::array();
  for (std::size_t v = 0; v < plan_.missions.size(); ++v) {
    json news = vehicle(v, snapshot, clock_ms);
    const bool done = news["state"] == "resting";
    fleet["goals"].push_back({{"name", "load of " + plan_.missions[v].vehicle},
                              {"from", "start"},
                              {"to", "bay of " + plan_.missions[v].vehicle},
                              {"amount", 1},
                              {"delivered", done ? 1 : 0},
                              {"state", done ? "delivered" : "carried"},
                              {"vehicle", plan_.missions[v].vehicle}});
    fleet["vehicles"].push_back(std::move(news));
  }
  return document_.dump();
}

}  // namespace stepwright::browser
