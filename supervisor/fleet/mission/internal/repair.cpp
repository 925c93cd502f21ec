#include "supervisor/fleet/mission/internal/repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <set>
#include <utility>

#include "supervisor/fleet/mission/internal/mission_builder.h"
#include "supervisor/map/row_span.h"

namespace stepwright::fleet::internal {

namespace {

using geometry::ConvexPolygon;

constexpr double kMillimetres = 1000.0;
// Where the way is closed the lattice has a lot of poses to look at before that is proved.
const PathOptions kHasty{.first_weight = 2.0, .last_weight = 1.5, .most_expanded = 20'000};
const PathOptions kThorough{.first_weight = 2.0, .most_expanded = 500'000};
constexpr std::array kClearOf_m = {0.0, 8.0, 16.0, 30.0};

struct Avoided {
  std::uint32_t vehicle = 0;  // whose place it is
  ConvexPolygon area;
};

// Paths without a schedule, and why.
struct Node {
  std::vector<VehicleMission> missions;
  std::vector<std::vector<Avoided>> avoided;  // by vehicle
  Core core;
};

// A vehicle that keeps out of more than it does in the node.
struct Step {
  double longer_m = 0.0;  // of the node; the step is tried before it is known what it costs
  std::size_t order = 0;
  std::size_t node = 0;
  std::uint32_t vehicle = 0;
  std::vector<Avoided> more;

  bool operator>(const Step& other) const {
    return std::pair(longer_m, order) > std::pair(other.longer_m, other.order);
  }
};

class Repair {
 public:
  Repair(const Attempt& input, const std::vector<VehicleMission>& missions, const Core& core)
      : input_(input), first_(missions) {
    nodes_.push_back({missions, std::vector<std::vector<Avoided>>(missions.size()), core});
    add_steps(0);
  }

  RepairAnswer run() {
    RepairAnswer answer;
    while (!open_.empty() && answer.tried < input_.options.alternatives && !input_.over()) {
      const Step step = open_.top();
      open_.pop();
      ++answer.tried;
      if (input_.on_tried) input_.on_tried(answer.tried);
      if (auto schedule = take(step)) {
        answer.found = shortened(nodes_.back(), *std::move(schedule));
        return answer;
      }
    }
    answer.all_tried = open_.empty();
    return answer;
  }

 private:
  // Steps for both vehicles of each section, around where the other stands first.
  void add_steps(std::size_t node) {
    const Node& of = nodes_[node];
    for (const auto& section : of.core.sections) {
      for (const bool first : {true, false}) {
        const auto& pair = section.front();
        const std::uint32_t vehicle = first ? pair.a.vehicle : pair.b.vehicle;
        const std::uint32_t other = first ? pair.b.vehicle : pair.a.vehicle;
        if (!is_planned(input_.problem.vehicles[vehicle]) || input_.routes[vehicle].empty()) continue;
        std::set<std::uint32_t> met;
        for (const SpatialPair& p : section) met.insert(first ? p.b.polygon : p.a.polygon);
        const auto& polygons = of.missions[other].grown.envelope.polygons;
        const auto last = static_cast<std::uint32_t>(polygons.size() - 1);
        std::set<std::uint32_t> stands;
        for (const std::uint32_t k : met) {
          if (k == 0 || k == last) stands.insert(k);
        }
        if (!stands.empty()) add_step(node, vehicle, other, stands);
        // All of it, then less and less of what is near the places where it must stand itself.
        std::set<std::uint32_t> tried = stands;
        for (const double distance_m : kClearOf_m) {
          const auto kept = beyond(of.missions[vehicle], of.missions[other], met, distance_m);
          if (kept == tried || kept.empty()) continue;
          add_step(node, vehicle, other, kept);
          tried = kept;
        }
      }
    }
  }

  // Those of the polygons of `other` that are farther from all stands of `mission`.
  static std::set<std::uint32_t> beyond(const VehicleMission& mission, const VehicleMission& other,
                                        const std::set<std::uint32_t>& polygons, double distance_m) {
    std::vector<geometry::Point> stands = {mission.path.front().pose.position()};
    for (const Stop& stop : mission.stops) stands.push_back(mission.path[stop.pose].pose.position());
    std::set<std::uint32_t> kept;
    for (const std::uint32_t k : polygons) {
      const geometry::Point middle = other.grown.envelope.polygons[k].area.centroid();
      const auto near = [&](geometry::Point stand) { return distance(stand, middle) <= distance_m; };
      if (std::ranges::none_of(stands, near)) kept.insert(k);
    }
    return kept;
  }

  void add_step(std::size_t node, std::uint32_t vehicle, std::uint32_t other,
                const std::set<std::uint32_t>& polygons) {
    const Node& of = nodes_[node];
    Step step{.longer_m = longer(of), .order = order_++, .node = node, .vehicle = vehicle, .more = {}};
    for (const std::uint32_t k : polygons) {
      const ConvexPolygon& area = of.missions[other].grown.envelope.polygons[k].area;
      // Where it has to stand itself it cannot keep out.
      if (!stands_in(of.missions[vehicle], area)) step.more.push_back({other, area});
    }
    if (!step.more.empty()) open_.push(std::move(step));
  }

  static bool stands_in(const VehicleMission& mission, const ConvexPolygon& area) {
    const geometry::Footprint outline = mission.model.footprint();
    if (overlaps(footprint_at(mission.path.front().pose, outline), area)) return true;
    return std::ranges::any_of(mission.stops, [&](const Stop& stop) {
      return overlaps(footprint_at(mission.path[stop.pose].pose, outline), area);
    });
  }

  double longer(const Node& node) const {
    double sum_m = 0.0;
    for (std::size_t v = 0; v < node.missions.size(); ++v) {
      sum_m += length_m(node.missions[v]) - length_m(first_[v]);
    }
    return sum_m;
  }

  // A schedule, or a new node if there is a path but no schedule. Paths that were tried are not tried again.
  std::optional<Schedule> take(const Step& step) {
    std::vector<Avoided> avoided = nodes_[step.node].avoided[step.vehicle];
    avoided.insert(avoided.end(), step.more.begin(), step.more.end());
    auto mission = plan_around(step.vehicle, avoided, kHasty);
    if (!mission) return std::nullopt;
    Node next{nodes_[step.node].missions, nodes_[step.node].avoided, {}};
    next.missions[step.vehicle] = *std::move(mission);
    next.avoided[step.vehicle] = std::move(avoided);
    if (!seen_.insert(lengths(next)).second) return std::nullopt;
    Schedule made = input_.schedule_of(input_.routes, next.missions);
    const bool scheduled = made.verdict == Verdict::Scheduled;
    if (made.verdict == Verdict::Infeasible) next.core = made.core;
    nodes_.push_back(std::move(next));
    if (scheduled) return made;
    add_steps(nodes_.size() - 1);
    return std::nullopt;
  }

  // The paths were found in haste: around the same places again, as short as can be.
  Repaired shortened(Node node, Schedule schedule) const {
    for (std::uint32_t v = 0; v < node.avoided.size() && !input_.over(); ++v) {
      if (node.avoided[v].empty()) continue;
      auto mission = plan_around(v, node.avoided[v], kThorough);
      if (!mission || length_m(*mission) >= length_m(node.missions[v])) continue;
      std::swap(node.missions[v], *mission);
      Schedule made = input_.schedule_of(input_.routes, node.missions);
      if (made.verdict == Verdict::Scheduled) {
        schedule = std::move(made);
      } else {
        std::swap(node.missions[v], *mission);
      }
    }
    auto changed = changes(node);
    return {std::move(node.missions), std::move(schedule), std::move(changed)};
  }

  // The route with these places closed, for its polygons as well.
  std::optional<VehicleMission> plan_around(std::uint32_t vehicle, const std::vector<Avoided>& avoided,
                                            const PathOptions& options) const {
    OccupancyGrid map = input_.floor.map();
    for (const Avoided& place : avoided) block(map, place.area);
    const MissionVehicle& asked = input_.problem.vehicles[vehicle];
    const Route& stops = input_.routes[vehicle];
    const PathPlanner planner = input_.floor.planner(asked.vehicle_class).on(map);
    const auto paths = input_.paths_through(input_.problem, asked.start, stops, planner, options);
    if (!paths) return std::nullopt;
    auto mission =
        route_mission(input_.problem, vehicle, stops, borrowed(*paths), map, input_.options.envelope);
    if (!mission) return std::nullopt;
    if (input_.options.pace) input_.options.pace(*mission);
    return *std::move(mission);
  }

  static std::vector<std::int64_t> lengths(const Node& node) {
    std::vector<std::int64_t> all;
    for (const VehicleMission& mission : node.missions) {
      all.push_back(std::llround(kMillimetres * length_m(mission)));
      all.push_back(static_cast<std::int64_t>(mission.grown.envelope.polygons.size()));
      double sum_m = 0.0;
      for (const auto& pose : mission.path) sum_m += pose.pose.x_m - 2.0 * pose.pose.y_m;
      all.push_back(std::llround(kMillimetres * sum_m));
    }
    return all;
  }

  std::vector<PathChange> changes(const Node& node) const {
    std::vector<PathChange> all;
    for (std::uint32_t v = 0; v < node.avoided.size(); ++v) {
      if (node.avoided[v].empty()) continue;
      std::set<std::uint32_t> around;
      for (const Avoided& place : node.avoided[v]) around.insert(place.vehicle);
      all.push_back({v, {around.begin(), around.end()}, length_m(node.missions[v]) - length_m(first_[v])});
    }
    return all;
  }

  const Attempt& input_;
  const std::vector<VehicleMission>& first_;
  std::vector<Node> nodes_;
  std::priority_queue<Step, std::vector<Step>, std::greater<>> open_;
  std::size_t order_ = 0;
  std::set<std::vector<std::int64_t>> seen_;
};

}  // namespace

RepairAnswer repair(const Attempt& input, const std::vector<VehicleMission>& missions, const Core& core) {
  return Repair(input, missions, core).run();
}

}  // namespace stepwright::fleet::internal
