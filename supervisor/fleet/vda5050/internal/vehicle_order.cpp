#include "supervisor/fleet/vda5050/internal/vehicle_order.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace stepwright::fleet::vda5050 {

namespace {

double within_half_turn(double angle_rad) {
  return std::remainder(angle_rad, 2.0 * std::numbers::pi);
}

Trajectory trajectory_of(const std::vector<geometry::PathPose>& way) {
  Trajectory curve;
  const double begin = way.front().arc_m, length = way.back().arc_m - begin;
  curve.knots.push_back(0.0);
  for (std::size_t k = 0; k < way.size(); ++k) {
    const double even = static_cast<double>(k) / static_cast<double>(way.size() - 1);
    curve.knots.push_back(length > 0.0 ? std::clamp((way[k].arc_m - begin) / length, 0.0, 1.0) : even);
    curve.points.push_back({way[k].pose.x_m, way[k].pose.y_m});
  }
  curve.knots.push_back(1.0);
  return curve;
}

const char* action_type(StopKind kind) {
  switch (kind) {
    case StopKind::PickUp:
      return "pick";
    case StopKind::SetDown:
      return "drop";
    case StopKind::Park:
      return "startCharging";
    case StopKind::GiveWay:
      break;
  }
  return "";
}

}  // namespace

VehicleOrder::VehicleOrder(std::string id, const OrderOptions& options, bool charging)
    : options_(&options), charging_(charging) {
  whole_.order_id = std::move(id);
}

// Unique in the order, also among horizons that were given up.
std::string VehicleOrder::part_id(char kind, std::size_t sequence) const {
  const std::string revision = revision_ == 0 ? "" : ".r" + std::to_string(revision_);
  return whole_.order_id + revision + "." + kind + std::to_string(sequence);
}

std::vector<Action> VehicleOrder::actions_for(const VehicleMission& mission, const RouteNode& at,
                                              std::size_t index) const {
  std::vector<Action> actions;
  const auto add = [&](const char* type) {
    actions.push_back({.type = type,
                       .id = part_id('n', 2 * index) + ".a" + std::to_string(actions.size()),
                       .blocking = Blocking::Hard,
                       .parameters = {}});
  };
  if (index == 0 && charging_) add("stopCharging");
  for (const std::size_t s : at.stops) {
    const Stop& stop = mission.stops[s];
    const bool last = s + 1 == mission.stops.size() && stop.pose + 1 == mission.path.size();
    const bool charges =
        stop.kind == StopKind::Park && last && options_->charging_locations.contains(stop.location);
    if (!moves_load(stop.kind) && !charges) continue;
    add(action_type(stop.kind));
    if (charges) continue;
    auto& parameters = actions.back().parameters;
    parameters.emplace_back("stationName", stop.location);
    if (!stop.goal.empty()) parameters.emplace_back("loadId", stop.goal);
    if (stop.amount > 1) parameters.emplace_back("amount", static_cast<double>(stop.amount));
  }
  return actions;
}

Node VehicleOrder::node_for(const VehicleMission& mission, const RouteNode& at, std::size_t index) {
  const geometry::Pose& pose = mission.path[at.pose].pose;
  return {.id = part_id('n', 2 * index),
          .sequence = static_cast<std::uint32_t>(2 * index),
          .description = at.stops.empty() ? std::string() : mission.stops[at.stops.front()].location,
          .released = false,
          .position = NodePosition{.x_m = pose.x_m,
                                   .y_m = pose.y_m,
                                   .theta_rad = within_half_turn(pose.heading_rad),
                                   .deviation_xy_m = at.deviation_m,
                                   .deviation_theta_rad = at.deviation_rad,
                                   .map_id = options_->map_id},
          .actions = actions_for(mission, at, index)};
}

// Appended behind the node with this index.
Edge VehicleOrder::edge_for(const VehicleMission& mission, std::size_t from, std::size_t to,
                            std::size_t index) const {
  const geometry::Path& path = mission.path;
  const bool reverse = path[to].travel == geometry::Travel::Reverse;
  return {.id = part_id('e', 2 * index + 1),
          .sequence = static_cast<std::uint32_t>(2 * index + 1),
          .released = false,
          .start_node = whole_.nodes[index].id,
          .end_node = part_id('n', 2 * index + 2),
          .max_speed_mps = mission.speed.max_mps,
          .orientation_rad = reverse ? std::numbers::pi : 0.0,
          .rotation_allowed = false,
          .length_m = path[to].arc_m - path[from].arc_m,
          .trajectory = trajectory_of(thinned(path, from, to, options_->route.trajectory_tolerance_m)),
          .actions = {}};
}

void VehicleOrder::lay(const VehicleMission& mission, const Route& route, std::size_t keep) {
  if (keep > 0) {
    ++revision_;
    whole_.nodes.resize(keep);
    whole_.edges.resize(keep - 1);
    waypoints_.resize(keep);
    waypoints_.back().next = route.nodes.front().polygon;
    waypoints_.back().way.clear();
  }
  for (std::size_t k = keep > 0 ? 1 : 0; k < route.nodes.size(); ++k) {
    const RouteNode& at = route.nodes[k];
    if (k > 0) {
      const std::size_t from = route.nodes[k - 1].pose;
      whole_.edges.push_back(edge_for(mission, from, at.pose, whole_.nodes.size() - 1));
      waypoints_.back().way.assign(mission.path.begin() + static_cast<std::ptrdiff_t>(from),
                                   mission.path.begin() + static_cast<std::ptrdiff_t>(at.pose) + 1);
    }
    whole_.nodes.push_back(node_for(mission, at, whole_.nodes.size()));
    Waypoint point{.polygon = at.polygon,
                   .next = at.polygon,
                   .arc_m = mission.path[at.pose].arc_m,
                   .way = {},
                   .stops = {}};
    for (const std::size_t s : at.stops) point.stops.push_back(mission.stops[s]);
    waypoints_.push_back(std::move(point));
  }
  done_ = false;
  mark_released();
}

void VehicleOrder::set_place(std::size_t node, std::uint32_t polygon, double arc_m) {
  waypoints_[node].polygon = polygon;
  waypoints_[node].next = polygon;
  waypoints_[node].arc_m = arc_m;
}

bool VehicleOrder::sent(const Order& order) const {
  if (order.order_id != whole_.order_id || order.update_id > whole_.update_id) return false;
  const auto found = std::ranges::find(pending_, order.update_id, &Order::update_id);
  if (found == pending_.end()) return true;
  return found->nodes == order.nodes && found->edges == order.edges;
}

std::size_t VehicleOrder::passed(double arc_m, double reach_m) const {
  const auto ahead =
      std::ranges::find_if(waypoints_, [&](const Waypoint& point) { return point.arc_m > arc_m + reach_m; });
  return static_cast<std::size_t>(ahead - waypoints_.begin());
}

void VehicleOrder::mark_released() {
  for (std::size_t k = 0; k <= released_; ++k) whole_.nodes[k].released = true;
  for (std::size_t k = 0; k < released_; ++k) whole_.edges[k].released = true;
}

bool VehicleOrder::release(std::uint32_t clear) {
  const std::size_t before = released_;
  while (released_ + 1 < waypoints_.size() && waypoints_[released_].next < clear) ++released_;
  mark_released();
  return released_ > before;
}

Order VehicleOrder::first(Header header) {
  whole_.header = std::move(header);
  sent_ = released_;
  pending_ = {whole_};
  return whole_;
}

Order VehicleOrder::update(Header header) {
  const auto from = static_cast<std::ptrdiff_t>(sent_);
  pending_.push_back({.header = std::move(header),
                      .order_id = whole_.order_id,
                      .update_id = ++whole_.update_id,
                      .nodes = {whole_.nodes.begin() + from, whole_.nodes.end()},
                      .edges = {whole_.edges.begin() + from, whole_.edges.end()}});
  sent_ = released_;
  return pending_.back();
}

result::Result<std::optional<std::uint32_t>> VehicleOrder::take(const State& state,
                                                                const std::string& source) {
  const auto refuse = [&](const std::string& message) {
    return result::fail("F0907", {source, 0, 0}, message, "is another master control at work?");
  };
  if (state.order_id != whole_.order_id) return std::nullopt;  // not taken yet
  if (state.update_id > whole_.update_id) {
    return refuse("/orderUpdateId: " + std::to_string(state.update_id) + " was never sent");
  }
  const std::size_t index = state.last_node_sequence / 2;
  const bool ours = index < whole_.nodes.size() && whole_.nodes[index].id == state.last_node;
  // Before the first node it names a node of the order before.
  if (!ours && traversed_)
    return refuse("/lastNodeId: '" + state.last_node + "' is not where the order leads");
  if (ours && index > sent_) return refuse("/lastNodeId: '" + state.last_node + "' was not released");
  std::erase_if(pending_, [&](const Order& sent) { return sent.update_id <= state.update_id; });
  if (!ours || (traversed_ && index < *traversed_)) return std::nullopt;  // nothing, or nothing new
  traversed_ = index;
  done_ = index + 1 == whole_.nodes.size() && state.nodes.empty() &&
          std::ranges::none_of(state.actions, [](const ActionState& action) {
            return action.status != ActionStatus::Finished && action.status != ActionStatus::Failed;
          });
  return waypoints_[index].polygon;
}

}  // namespace stepwright::fleet::vda5050
