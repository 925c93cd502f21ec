#include "supervisor/fleet/mission/internal/give_way.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <queue>
#include <set>
#include <tuple>
#include <utility>

#include "supervisor/fleet/mission/internal/mission_builder.h"
#include "supervisor/map/row_span.h"

namespace stepwright::fleet::internal {

namespace {

using geometry::ConvexPolygon;
using geometry::Pose;

constexpr std::size_t kPlaces = 3;      // for a vehicle
constexpr double kApart_m = 4.0;        // from each other
constexpr std::size_t kMost = 100'000;  // poses looked at for them
constexpr std::size_t kNeighbours = 2;  // who are asked as well where one cannot get away
// The polygon in which it waits holds so much of the way to there, and grows by so much. Programs need the
// way: who is in it has left the one before without having to ask for the one behind it (F1103).
constexpr double kTail_m = 0.9;
constexpr double kTailGrowth_m = 0.1;
constexpr double kSwing_m = 0.5;   // beside its outline, where that way is a curve
constexpr double kSpare_m = 0.05;  // cells are blocked as wholes
const PathOptions kWays{.first_weight = 1.5, .last_weight = 1.5, .most_expanded = 500'000};

// Who gives way where so far, and why that leaves no schedule.
struct Node {
  std::vector<VehicleMission> missions;
  std::vector<Route> routes;
  std::vector<GaveWay> moved;
  Core core;
  double longer_m = 0.0;
};

struct Step {
  std::size_t moved = 0;  // vehicles, with this one
  double longer_m = 0.0;  // at least
  std::size_t order = 0;
  std::size_t node = 0;
  GaveWay move;

  bool operator>(const Step& other) const {
    return std::tuple(moved, longer_m, order) > std::tuple(other.moved, other.longer_m, other.order);
  }
};

struct Place {
  Pose pose;
  double cost_m = 0.0;
};

geometry::Footprint wider(const geometry::Footprint& outline, double along_m, double beside_m) {
  return {outline.front_m + along_m, outline.rear_m + along_m, outline.half_width_m + beside_m};
}

std::size_t pose_at(const geometry::Path& path, double arc_m) {
  const auto at = std::ranges::lower_bound(path, arc_m, {}, &geometry::PathPose::arc_m);
  return std::min(path.size() - 1, static_cast<std::size_t>(at - path.begin()));
}

class GiveWay {
 public:
  GiveWay(const Attempt& input, const std::vector<VehicleMission>& missions, const Core& core)
      : input_(input), problem_(input.problem) {
    nodes_.push_back({missions, input.routes, {}, core, 0.0});
    add_steps(0);
  }

  WayGivenAnswer run() {
    WayGivenAnswer answer;
    while (!open_.empty() && answer.tried < input_.options.alternatives && !input_.over()) {
      const Step step = open_.top();
      open_.pop();
      ++answer.tried;
      if (input_.on_tried) input_.on_tried(answer.tried);
      if (auto schedule = take(step)) {
        Node& node = nodes_.back();
        answer.found = WayGiven{std::move(node.missions), std::move(node.routes), *std::move(schedule),
                                std::move(node.moved)};
        return answer;
      }
    }
    for (const std::uint32_t v : without_place_)
      answer.reason += fmt::format("{} finds no place where it is in nobody's way\n", name(v));
    if (answer.tried > 0) {
      answer.reason +=
          fmt::format("{} place{} to give way did not help{}\n", answer.tried, answer.tried == 1 ? "" : "s",
                      open_.empty() ? "" : "; there may be more than were tried");
    }
    return answer;
  }

 private:
  const std::string& name(std::uint32_t v) const { return input_.problem.vehicles[v].name; }

  bool may_move(const Node& node, std::uint32_t v) const {
    return is_planned(problem_.vehicles[v]) &&
           std::ranges::find(node.moved, v, &GaveWay::vehicle) == node.moved.end();
  }

  // Whoever is to blame; those without anything to do first.
  void add_steps(std::size_t node) {
    if (nodes_[node].moved.size() >= input_.options.give_way) return;
    std::vector<std::uint32_t> asked;
    for (const std::uint32_t v : nodes_[node].core.vehicles) {
      if (may_move(nodes_[node], v)) asked.push_back(v);
    }
    std::ranges::stable_sort(asked, {}, [&](std::uint32_t v) { return !input_.routes[v].empty(); });
    std::vector<std::uint32_t> shut_in;
    for (const std::uint32_t v : asked)
      if (!add_steps_of(node, v)) shut_in.push_back(v);
    for (const std::uint32_t v : shut_in) {
      for (const std::uint32_t other : neighbours(nodes_[node], v)) {
        if (std::ranges::find(asked, other) != asked.end()) continue;
        asked.push_back(other);
        add_steps_of(node, other);
      }
    }
  }

  bool add_steps_of(std::size_t node, std::uint32_t v) {
    const Node& of = nodes_[node];
    const auto found = places(of, v);
    for (const Place& place : found) {
      open_.push({.moved = of.moved.size() + 1,
                  .longer_m = of.longer_m + place.cost_m,
                  .order = order_++,
                  .node = node,
                  .move = {v, place.pose}});
    }
    if (found.empty() && node == 0) without_place_.insert(v);
    return !found.empty();
  }

  // Who stands nearest.
  std::vector<std::uint32_t> neighbours(const Node& node, std::uint32_t v) const {
    std::vector<std::uint32_t> others;
    for (std::uint32_t u = 0; u < problem_.vehicles.size(); ++u)
      if (u != v && may_move(node, u)) others.push_back(u);
    const geometry::Point here = problem_.vehicles[v].start.position();
    std::ranges::stable_sort(others, {}, [&](std::uint32_t u) {
      return geometry::distance(problem_.vehicles[u].start.position(), here);
    });
    others.resize(std::min(others.size(), kNeighbours));
    return others;
  }

  // Who stays where it is until somebody gives way, or for ever: nobody gets past.
  bool stays(const Node& node, std::uint32_t v) const {
    if (!may_move(node, v)) return !is_planned(problem_.vehicles[v]);
    return node.routes[v].empty() || std::ranges::find(node.core.vehicles, v) != node.core.vehicles.end();
  }

  // The floor that the vehicle can leave its start on.
  OccupancyGrid floor_past_others(const Node& node, std::uint32_t v) const {
    const OccupancyGrid& floor = input_.floor.map();
    OccupancyGrid map = floor;
    for (std::uint32_t u = 0; u < node.missions.size(); ++u) {
      const VehicleMission& other = node.missions[u];
      if (u == v || other.path.empty() || !stays(node, u)) continue;
      block(map, footprint_at(other.path.front().pose, other.model.footprint()));
    }
    // Cells are blocked as wholes, and others may stand near.
    const VehicleModel& model = node.missions[v].model;
    const double needed_m = SweptCells::clearance_m(model) + kSpare_m;
    const geometry::Footprint own = wider(model.footprint(), needed_m, needed_m);
    for (const RowSpan& span : covered_spans(footprint_at(problem_.vehicles[v].start, own), floor.frame())) {
      for (std::int32_t column = span.first; column <= span.last; ++column) {
        const Cell cell{column, span.row};
        if (floor.contains(cell)) map.set(cell, floor.blocked(cell));
      }
    }
    return map;
  }

  // The floor on which it goes on: others have come to where they stay.
  OccupancyGrid floor_around_ends(const Node& node, std::uint32_t v) const {
    OccupancyGrid map = input_.floor.map();
    for (std::uint32_t u = 0; u < node.missions.size(); ++u)
      if (u != v) block(map, node.missions[u].grown.envelope.polygons.back().area);
    return map;
  }

  // Where others stand and drive, and nothing else.
  OccupancyGrid ways_of_others(const Node& node, std::uint32_t v) const {
    OccupancyGrid ways(input_.floor.map().frame());
    for (std::uint32_t u = 0; u < node.missions.size(); ++u) {
      if (u == v) continue;
      for (const EnvelopePolygon& polygon : node.missions[u].grown.envelope.polygons)
        block(ways, polygon.area);
    }
    return ways;
  }

  // Nothing for a vehicle that is in nobody's way where it stands: it need not leave.
  std::vector<Place> places(const Node& node, std::uint32_t v) const {
    const OccupancyGrid map = floor_past_others(node, v);
    const OccupancyGrid ways = ways_of_others(node, v);
    const double grown_m = std::max(input_.options.envelope.stand_growth_m, kTailGrowth_m) + 2.0 * kSpare_m;
    const geometry::Footprint room =
        wider(node.missions[v].model.footprint(), grown_m + kTail_m, grown_m + kSwing_m);
    const OccupancyGrid& floor = input_.floor.map();
    std::vector<Place> found;
    const auto take = [&](const Pose& at, std::uint32_t cost_mm) {
      if (input_.over()) return false;
      const ConvexPolygon area = footprint_at(at, room);
      if (overlaps_way(ways, floor, area)) return true;
      if (cost_mm == 0) return false;
      const bool near = std::ranges::any_of(found, [&](const Place& other) {
        return geometry::distance(other.pose.position(), at.position()) < kApart_m;
      });
      if (!near) found.push_back({at, 1e-3 * cost_mm});
      return found.size() < kPlaces;
    };
    input_.work.expanded += input_.floor.planner(problem_.vehicles[v].vehicle_class)
                                .on(map)
                                .visit_reachable(problem_.vehicles[v].start, kMost, take);
    return found;
  }

  // What lies off the map is nobody's way: the polygon of a stand does not grow there.
  static bool overlaps_way(const OccupancyGrid& ways, const OccupancyGrid& floor, const ConvexPolygon& area) {
    const auto spans = covered_spans(area, ways.frame());
    return std::ranges::any_of(spans, [&](const RowSpan& span) {
      for (std::int32_t column = span.first; column <= span.last; ++column) {
        const Cell cell{column, span.row};
        if (floor.contains(cell) && ways.blocked(cell)) return true;
      }
      return false;
    });
  }

  std::optional<Schedule> take(const Step& step) {
    Node next = nodes_[step.node];
    const std::uint32_t v = step.move.vehicle;
    auto mission = mission_by(step.node, step.move, next.routes[v]);
    if (!mission || waits_in_a_way(next, v, *mission)) return std::nullopt;
    next.longer_m += length_m(*mission) - length_m(next.missions[v]);
    next.missions[v] = *std::move(mission);
    next.moved.push_back(step.move);
    Schedule made = input_.schedule_of(next.routes, next.missions);
    const bool scheduled = made.verdict == Verdict::Scheduled;
    if (made.verdict == Verdict::Infeasible) next.core = made.core;
    nodes_.push_back(std::move(next));
    if (scheduled) return made;
    add_steps(nodes_.size() - 1);
    return std::nullopt;
  }

  // Who waits in one of these polygons could not leave it for somebody who has to come first.
  static bool waits_in_a_way(const Node& node, std::uint32_t v, const VehicleMission& mission) {
    const auto stop = std::ranges::find(mission.stops, StopKind::GiveWay, &Stop::kind);
    const auto& own = mission.grown.envelope.polygons;
    const std::size_t first = mission.grown.stands[static_cast<std::size_t>(stop - mission.stops.begin())];
    for (std::size_t k = first; k < std::min(first + 2, own.size()); ++k) {
      for (std::uint32_t u = 0; u < node.missions.size(); ++u) {
        const auto met = [&](const EnvelopePolygon& other) { return overlaps(other.area, own[k].area); };
        if (u != v && std::ranges::any_of(node.missions[u].grown.envelope.polygons, met)) return true;
      }
    }
    return false;
  }

  // By way of the place, behind stops that are made where it stands; the route gets that stop.
  std::optional<VehicleMission> mission_by(std::size_t node, const GaveWay& move, Route& route) {
    const MissionVehicle& vehicle = problem_.vehicles[move.vehicle];
    const auto here = [&](const RouteStop& stop) {
      return geometry::distance(problem_.locations[stop.location].pose.position(), vehicle.start.position()) <
             1e-6;
    };
    const auto made = std::ranges::find_if_not(route, here) - route.begin();
    problem_.locations.push_back(
        {.name = fmt::format("({:.1f} m, {:.1f} m), out of the way", move.place.x_m, move.place.y_m),
         .pose = move.place,
         .key = vehicle.key});
    RouteStop stop{.kind = StopKind::GiveWay,
                   .location = problem_.locations.size() - 1,
                   .goal = {},
                   .task = {},
                   .amount = 0,
                   .aboard = made > 0 ? route[static_cast<std::size_t>(made) - 1].aboard : 0};
    route.insert(route.begin() + made, stop);
    const PathPlanner& planner = input_.floor.planner(vehicle.vehicle_class);
    const auto split = route.begin() + made + 1;
    auto mission = way_out(node, move.vehicle, Route(route.begin(), split));
    if (mission && split != route.end()) {
      const Route rest(split, route.end());
      const OccupancyGrid around = floor_around_ends(nodes_[node], move.vehicle);
      auto second = way_on(move, rest, planner.on(around));
      if (!second) second = way_on(move, rest, planner);
      if (!second) return std::nullopt;
      mission = joined(*std::move(mission), *std::move(second));
    }
    if (mission && input_.options.pace) input_.options.pace(*mission);
    return mission;
  }

  // From where it stands past all who stay. Its polygons are tight: others stand near.
  std::optional<VehicleMission> way_out(std::size_t node, std::uint32_t v, const Route& stops) const {
    const MissionVehicle& vehicle = problem_.vehicles[v];
    const OccupancyGrid past = floor_past_others(nodes_[node], v);
    const auto paths = input_.paths_through(problem_, vehicle.start, stops,
                                            input_.floor.planner(vehicle.vehicle_class).on(past), kWays);
    if (!paths) return std::nullopt;
    VehicleMission mission = nodes_[node].missions[v];
    mission.stops = stops_on(problem_, stops, borrowed(*paths));
    mission.path = behind(vehicle.lead_in, join_legs(borrowed(*paths)), mission.stops);
    if (mission.path.size() < 3) return std::nullopt;
    EnvelopeOptions tight = input_.options.envelope;
    tight.growth_m = 0.0;
    tight.speed = vehicle.speed;
    EnvelopeOptions begin = tight, tail = tight;
    begin.stretch_m = 0.0;
    tail.growth_m = kTailGrowth_m;
    tail.stretch_m = 2.0 * kTail_m;
    const std::size_t last = mission.path.size() - 1;
    const std::size_t waits =
        std::clamp<std::size_t>(pose_at(mission.path, length_m(mission) - kTail_m), 1, last - 1);
    std::vector<EnvelopePart> parts = {{1, begin}};
    if (waits > 1) parts.push_back({waits, tight});
    parts.push_back({last, tail});
    auto grown =
        grow_in_parts(input_.floor.map(), mission.model.footprint(), mission.vehicle, mission.path, parts);
    if (!grown) return std::nullopt;
    mission.grown = *std::move(grown);
    mission.grown.stands.assign(mission.stops.size() - 1, 0);
    mission.grown.stands.push_back(mission.grown.visits.size() - 1);
    return mission;
  }

  // From the place through all other stops.
  std::optional<VehicleMission> way_on(const GaveWay& move, const Route& stops,
                                       const PathPlanner& planner) const {
    const auto paths = input_.paths_through(problem_, move.place, stops, planner, kWays);
    if (!paths) return std::nullopt;
    auto mission = build_mission(problem_, move.vehicle, join_legs(borrowed(*paths)),
                                 stops_on(problem_, stops, borrowed(*paths)), input_.floor.map(),
                                 input_.options.envelope);
    return mission ? std::optional(*std::move(mission)) : std::nullopt;
  }

  const Attempt& input_;
  MissionProblem problem_;  // with the places to give way as locations
  std::vector<Node> nodes_;
  std::priority_queue<Step, std::vector<Step>, std::greater<>> open_;
  std::size_t order_ = 0;
  std::set<std::uint32_t> without_place_;
};

}  // namespace

WayGivenAnswer give_way(const Attempt& input, const std::vector<VehicleMission>& missions, const Core& core) {
  return GiveWay(input, missions, core).run();
}

}  // namespace stepwright::fleet::internal
