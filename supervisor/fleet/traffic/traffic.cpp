#include "supervisor/fleet/traffic/traffic.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "supervisor/fleet/traffic/no_order.h"

namespace stepwright::fleet {

namespace {

using internal::Lane;
using std::chrono::milliseconds;

constexpr double kAtEnd_m = 0.06;
constexpr double kStands_m_s = 0.02;

double seconds(milliseconds time) {
  return std::chrono::duration<double>(time).count();
}
milliseconds whole(double s) {
  return milliseconds(static_cast<milliseconds::rep>(std::llround(1e3 * s)));
}

}  // namespace

result::Result<Traffic> Traffic::create(std::vector<Route> routes, const TrafficSettings& settings,
                                        milliseconds now) {
  Traffic traffic(settings);
  for (Route& route : routes) {
    Lane lane;
    lane.arc_m = route.mission.path.front().arc_m;
    lane.route = std::move(route);
    traffic.lanes_.push_back(std::move(lane));
  }
  std::vector<const Lane*> lanes;
  for (const Lane& lane : traffic.lanes_) lanes.push_back(&lane);
  auto planned = traffic.plan(lanes, std::nullopt, now);
  if (!planned) return result::forward(planned);
  traffic.install(*std::move(planned), now);
  return traffic;
}

// --- measurements ---

void Traffic::progress(std::uint32_t vehicle, const VehicleLocation& at, milliseconds now) {
  Lane& lane = lanes_[vehicle];
  if (lane.removed) return;
  lane.arc_m = std::max(lane.arc_m, std::min(at.arc_m, lane.route.end_m()));
  lane.speed_m_s = at.speed_m_s;
  lane.standing_until = at.standing_until;
  leave(vehicle);
  grant(vehicle);
  post_delay(vehicle, now);
}

// Who rests is in his last polygon alone, also if he stands a little before the end.
void Traffic::leave(std::uint32_t vehicle) {
  Lane& lane = lanes_[vehicle];
  const bool resting = rests(vehicle);
  while (lane.first + 1 < lane.granted && (resting || lane.arc_m >= lane.route.left_m[lane.first]))
    ++lane.first;
}

// Who waited for a vehicle that is out of order goes on.
bool Traffic::open(std::uint32_t vehicle, std::uint32_t polygon) const {
  const Lane& lane = lanes_[vehicle];
  if (lane.limit_m && room_of_removed(lane.route.mission.grown.envelope.polygons[polygon].area)) return false;
  const auto [begin, end] = std::ranges::equal_range(lane.waits, polygon, {}, &internal::Wait::polygon);
  return std::all_of(begin, end, [&](const internal::Wait& wait) {
    const Lane& other = lanes_[wait.vehicle];
    return other.first > wait.left || other.removed;
  });
}

// Who is held there would stand where a vehicle out of order has to begin to drive again, for as long as that
// one stands in its way. No schedule says so: vehicles out of order are in none.
bool Traffic::room_of_removed(const geometry::ConvexPolygon& area) const {
  return std::ranges::any_of(lanes_, [&](const Lane& other) {
    if (!other.removed) return false;
    if (other.room && overlaps(*other.room, area)) return true;
    const auto& polygons = other.route.mission.grown.envelope.polygons;
    for (std::uint32_t k = other.first; k < other.granted; ++k)
      if (overlaps(polygons[k].area, area)) return true;
    return false;
  });
}

std::vector<geometry::ConvexPolygon> Traffic::rooms_of_others(std::uint32_t vehicle) const {
  std::vector<geometry::ConvexPolygon> rooms;
  for (std::uint32_t v = 0; v < lanes_.size(); ++v)
    if (v != vehicle && lanes_[v].removed && lanes_[v].room) rooms.push_back(*lanes_[v].room);
  return rooms;
}

std::uint32_t Traffic::behind_group(std::uint32_t vehicle, std::uint32_t polygon) const {
  const auto& needed_m = lanes_[vehicle].route.needed_m;
  std::uint32_t behind = polygon + 1;
  while (behind < needed_m.size() && needed_m[behind] == needed_m[polygon]) ++behind;
  return behind;
}

void Traffic::grant(std::uint32_t vehicle) {
  Lane& lane = lanes_[vehicle];
  while (lane.granted < lane.route.polygons()) {
    const double needed_m = lane.route.needed_m[lane.granted];
    if (needed_m > lane.arc_m + settings_.ahead_m || (lane.limit_m && needed_m >= *lane.limit_m)) return;
    const std::uint32_t behind = behind_group(vehicle, lane.granted);
    for (std::uint32_t k = lane.granted; k < behind; ++k)
      if (!open(vehicle, k)) return;
    lane.granted = behind;
  }
}

// When it can be at the next polygon at best, if that is later than the schedule has it.
void Traffic::post_delay(std::uint32_t vehicle, milliseconds now) {
  const Lane& lane = lanes_[vehicle];
  const auto& needed_m = lane.route.needed_m;
  const auto next =
      static_cast<std::uint32_t>(std::ranges::upper_bound(needed_m, lane.arc_m) - needed_m.begin());
  if (next >= needed_m.size()) return;
  const double way_s = lane.route.needed_s[next] - lane.route.pace.time_s(lane.arc_m, true);
  const milliseconds expected = std::max(now, lane.standing_until) + whole(std::max(0.0, way_s));
  if (expected <= entry(vehicle, next) + settings_.late) return;
  if (retiming_->not_before({row_of(vehicle, next), Side::Entry}, expected - since_)) ++delays_;
}

// It drives as soon as it may, and then waits before the next polygon.
void Traffic::keep_times(milliseconds now) {
  for (std::uint32_t v = 0; v < lanes_.size(); ++v) {
    Lane& lane = lanes_[v];
    if (lane.removed) continue;
    const Route& route = lane.route;
    while (lane.granted < route.polygons() && entry(v, lane.granted) <= now) ++lane.granted;
    while (lane.first + 1 < lane.granted && exit(v, lane.first) <= now) ++lane.first;
    const Start start = start_in(v, lane.granted - 1);
    const double time_s = start.at_s + std::max(0.0, seconds(now - start.time));
    double arc_m = std::min(route.pace.arc_m(time_s), route.end_m());
    if (lane.granted < route.polygons()) arc_m = std::min(arc_m, route.needed_m[lane.granted]);
    if (lane.limit_m) arc_m = std::min(arc_m, *lane.limit_m);
    if (arc_m < lane.arc_m) continue;
    lane.arc_m = arc_m;
    if (rests(v)) leave(v);
    const double behind_s = route.pace.time_s(arc_m, true);
    const bool stands = time_s >= route.pace.time_s(arc_m) && behind_s > time_s;
    lane.standing_until = stands ? now + whole(behind_s - time_s) : milliseconds(0);
  }
  for (std::uint32_t v = 0; v < lanes_.size(); ++v)
    if (!lanes_[v].removed) grant(v);
}

Traffic::Start Traffic::start_in(std::uint32_t vehicle, std::uint32_t polygon) const {
  const Lane& lane = lanes_[vehicle];
  const double needed_s = lane.route.needed_s[polygon];
  if (needed_s > lane.planned_from_s) return {entry(vehicle, polygon), needed_s};
  return {std::max(entry(vehicle, polygon), lane.planned_go), lane.planned_from_s};
}

milliseconds Traffic::expected(std::uint32_t vehicle, double arc_m) const {
  const Route& route = lanes_[vehicle].route;
  const auto behind = std::ranges::upper_bound(route.needed_m, arc_m) - route.needed_m.begin();
  const auto polygon =
      std::max(static_cast<std::uint32_t>(std::max<std::ptrdiff_t>(behind, 1) - 1), lanes_[vehicle].base);
  const Start start = start_in(vehicle, polygon);
  return start.time + whole(std::max(0.0, route.pace.time_s(arc_m, true) - start.at_s));
}

milliseconds Traffic::expected_end(std::uint32_t vehicle) const {
  return expected(vehicle, lanes_[vehicle].route.end_m());
}

// --- what vehicles may do ---

Permission Traffic::permission(std::uint32_t vehicle, milliseconds now) const {
  const Lane& lane = lanes_[vehicle];
  Permission permission{std::numeric_limits<double>::infinity(), {}};
  if (lane.removed) return {lane.arc_m, {}};
  if (lane.granted < lane.route.polygons()) {
    permission.permitted_m = lane.route.needed_m[lane.granted];
    const double way_m = permission.permitted_m - lane.arc_m;
    const milliseconds opens = entry(vehicle, lane.granted);
    if (opens > now && way_m >= settings_.slowest_gate_m_s * seconds(opens - now))
      permission.gate = Gate{permission.permitted_m, seconds(opens)};
  }
  if (lane.limit_m) permission.permitted_m = std::min(permission.permitted_m, *lane.limit_m);
  return permission;
}

bool Traffic::is_before_room(std::uint32_t vehicle, std::uint32_t removed) const {
  const Lane& lane = lanes_[vehicle];
  const auto& room = lanes_[removed].room;
  if (!room || lane.granted >= lane.route.polygons()) return false;
  const auto& polygons = lane.route.mission.grown.envelope.polygons;
  const std::uint32_t behind = behind_group(vehicle, lane.granted);
  for (std::uint32_t k = lane.granted; k < behind; ++k)
    if (overlaps(polygons[k].area, *room)) return true;
  return false;
}

std::optional<std::uint32_t> Traffic::waits_for(std::uint32_t vehicle) const {
  const Lane& lane = lanes_[vehicle];
  if (lane.granted >= lane.route.polygons()) return std::nullopt;
  const std::uint32_t behind = behind_group(vehicle, lane.granted);
  for (const internal::Wait& wait : lane.waits) {
    const Lane& other = lanes_[wait.vehicle];
    if (wait.polygon >= lane.granted && wait.polygon < behind && !other.removed && other.first <= wait.left)
      return wait.vehicle;
  }
  return std::nullopt;
}

bool Traffic::rests(std::uint32_t vehicle) const {
  return lanes_[vehicle].arc_m >= lanes_[vehicle].route.end_m() - kAtEnd_m;
}

// --- changes ---

std::optional<Branch> Traffic::branch(std::uint32_t vehicle) const {
  const Lane& lane = lanes_[vehicle];
  if (lane.removed) return std::nullopt;
  const geometry::Path& path = lane.route.mission.path;
  if (rests(vehicle)) return Branch{path.size() - 1, path.back().arc_m, path.back().pose};
  const double speed = std::abs(lane.speed_m_s);
  const double stop_m =
      speed < kStands_m_s ? 0.0 : settings_.reaction_m + speed * speed / (2.0 * settings_.brake_m_s2);
  const auto from =
      std::ranges::lower_bound(path, lane.arc_m + stop_m - 1e-6, {}, &geometry::PathPose::arc_m);
  const std::vector<geometry::ConvexPolygon> rooms = rooms_of_others(vehicle);
  std::optional<Branch> in_room;
  for (auto at = from; at != path.end(); ++at) {
    if (lane.limit_m && at->arc_m >= *lane.limit_m) return in_room;
    if (!on_lattice(at->pose, settings_.resolution_m)) continue;
    // It has to be able to stand in the polygon of the branch alone.
    const std::uint32_t in = polygon_at(lane.route, lane.first, at->arc_m);
    if (in > lane.first && at->arc_m - lane.route.mission.grown.visits[in - 1].exit_m < kLeft_m + kHalt_m)
      continue;
    const Branch branch{static_cast<std::size_t>(at - path.begin()), at->arc_m, at->pose};
    if (!meets_any(lane.route.mission.grown.envelope.polygons[in].area, rooms)) return branch;
    // There it would have to wait for the new way to be free; behind the room if there is such a place.
    if (!in_room) in_room = branch;
  }
  return in_room;
}

result::Result<Change> Traffic::reroute(std::uint32_t vehicle, const Branch& branch,
                                        const Route& continuation, milliseconds now) {
  const Lane& lane = lanes_[vehicle];
  const std::uint32_t last = polygon_at(lane.route, lane.first, branch.arc_m);
  auto route = splice(lane.route, lane.first, branch.pose, continuation);
  if (!route) return result::forward(route);
  Lane candidate = lane;
  candidate.granted = std::min(lane.granted, last + 1) - lane.first;
  candidate.first = 0;
  candidate.limit_m.reset();
  candidate.route = *std::move(route);
  pass_in_one_go(candidate.route, candidate.granted, rooms_of_others(vehicle));
  return adopt(vehicle, std::move(candidate), now);
}

void Traffic::hold(std::uint32_t vehicle, double arc_m) {
  lanes_[vehicle].limit_m = arc_m;
}

void Traffic::release(std::uint32_t vehicle) {
  lanes_[vehicle].limit_m.reset();
}

void Traffic::remove(std::uint32_t vehicle, std::optional<geometry::ConvexPolygon> room) {
  lanes_[vehicle].removed = true;
  lanes_[vehicle].room = std::move(room);
}

void Traffic::clear_rooms(milliseconds now) {
  for (std::uint32_t v = 0; v < lanes_.size(); ++v) {
    if (lanes_[v].removed) continue;
    Lane candidate = lanes_[v];
    pass_in_one_go(candidate.route, candidate.granted, rooms_of_others(v));
    if (candidate.route.needed_m != lanes_[v].route.needed_m) (void)adopt(v, std::move(candidate), now);
  }
}

result::Result<Change> Traffic::restore(std::uint32_t vehicle, Route route, milliseconds now) {
  Lane candidate;
  candidate.arc_m = route.mission.path.front().arc_m;
  candidate.route = std::move(route);
  pass_in_one_go(candidate.route, candidate.granted, rooms_of_others(vehicle));
  return adopt(vehicle, std::move(candidate), now);
}

result::Result<Change> Traffic::adopt(std::uint32_t vehicle, Lane candidate, milliseconds now) {
  std::vector<const Lane*> lanes;
  for (const Lane& lane : lanes_) lanes.push_back(&lane);
  lanes[vehicle] = &candidate;
  // Where the candidate is put in its place only if there is a schedule.
  auto planned = plan(lanes, vehicle, now);
  if (!planned) return result::forward(planned);
  lanes_[vehicle] = std::move(candidate);
  const Change change = planned->change;
  install(*std::move(planned), now);
  return change;
}

result::Result<Traffic::Planned> Traffic::plan(const std::vector<const Lane*>& lanes,
                                               std::optional<std::uint32_t> changed, milliseconds now) const {
  Planned planned;
  planned.remainder = internal::remainder_of(lanes, now, settings_.held);
  planned.overlaps = internal::overlaps_ahead(lanes, overlaps_, changed);
  const std::vector<SpatialPair> rows = internal::by_row(lanes, planned.overlaps);
  internal::keep_permissions(lanes, rows, planned.remainder);
  ScheduleOptions options{.mode = Mode::Strict, .conflicts = settings_.conflicts, .explain = false};
  planned.made = schedule(planned.remainder.envelopes, planned.remainder.constraints, rows, options);
  if (planned.made.verdict == Verdict::Exhausted && changed) {
    planned.change.orders_kept = true;
    internal::keep_orders(lanes, *changed, planned.remainder);
    planned.made = schedule(planned.remainder.envelopes, planned.remainder.constraints, rows, options);
  }
  planned.change.conflicts = planned.made.figures.conflicts;
  if (planned.made.verdict == Verdict::Scheduled) return planned;
  return result::fail(kNoOrder, {},
                      planned.made.verdict == Verdict::Infeasible
                          ? "there is no order in which all vehicles come to the end of their ways"
                          : fmt::format("no order was found within {} conflicts", settings_.conflicts));
}

void Traffic::install(Planned planned, milliseconds now) {
  const internal::Remainder& rest = planned.remainder;
  since_ = now;
  overlaps_ = std::move(planned.overlaps);
  retiming_.emplace(rest.envelopes, rest.constraints, planned.made);
  for (std::uint32_t row = 0; row < rest.vehicles.size(); ++row) {
    Lane& lane = lanes_[rest.vehicles[row]];
    lane.waits.clear();
    lane.row = row;
    lane.base = lane.first;
    lane.planned_from_s = lane.route.pace.time_s(lane.arc_m, true);
    lane.planned_go = std::max(now, lane.standing_until);
  }
  for (const Precedence& precedence : planned.made.precedences) {
    const std::uint32_t before = rest.vehicles[precedence.first.vehicle];
    Lane& lane = lanes_[rest.vehicles[precedence.second.vehicle]];
    lane.waits.push_back(
        {lane.first + precedence.second.polygon, before, lanes_[before].first + precedence.first.polygon});
  }
  for (std::uint32_t v = 0; v < lanes_.size(); ++v) {
    std::ranges::sort(lanes_[v].waits, {}, [](const internal::Wait& wait) {
      return std::tuple(wait.polygon, wait.vehicle, wait.left);
    });
  }
  for (const std::uint32_t v : rest.vehicles) grant(v);
}

PolygonRef Traffic::row_of(std::uint32_t vehicle, std::uint32_t polygon) const {
  return {lanes_[vehicle].row, polygon - lanes_[vehicle].base};
}

milliseconds Traffic::entry(std::uint32_t vehicle, std::uint32_t polygon) const {
  return since_ + retiming_->earliest({row_of(vehicle, polygon), Side::Entry});
}

milliseconds Traffic::exit(std::uint32_t vehicle, std::uint32_t polygon) const {
  return since_ + retiming_->earliest({row_of(vehicle, polygon), Side::Exit});
}

}  // namespace stepwright::fleet
