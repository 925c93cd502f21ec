#include "supervisor/fleet/mission/add_mission.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <optional>
#include <utility>

#include "supervisor/fleet/mission/explain_schedule.h"
#include "supervisor/fleet/mission/internal/mission_builder.h"
#include "supervisor/fleet/mission/internal/parallel.h"
#include "supervisor/fleet/network/constraint.h"
#include "supervisor/map/row_span.h"

namespace stepwright::fleet {

namespace {

using std::chrono::milliseconds;
using WallClock = std::chrono::steady_clock;

constexpr milliseconds kNever{kHorizon_ms};

double since_ms(WallClock::time_point begin) {
  return std::chrono::duration<double, std::milli>(WallClock::now() - begin).count();
}

class Addition {
 public:
  Addition(FleetFloor& floor, const FleetPlan& plan, const RunningPlan& running, const NewMission& mission,
           const AddOptions& options)
      : floor_(floor), plan_(plan), running_(running), mission_(mission), options_(options) {
    assert(!mission.stops.empty() && running.times.size() == plan.missions.size());
  }

  AddedMission run() {
    const auto begin = WallClock::now();
    added_.vehicle = choose();
    for (; added_.alternatives <= options_.alternatives; ++added_.alternatives) {
      auto extended = extend();
      if (!extended) break;
      if (order(*std::move(extended)) || !avoid_more()) break;
    }
    added_.alternatives = std::min(added_.alternatives, options_.alternatives);
    added_.total_ms = since_ms(begin);
    return std::move(added_);
  }

 private:
  const VehicleMission& own() const { return plan_.missions[added_.vehicle]; }

  std::size_t model_of(const VehicleMission& mission) const {
    std::size_t model = 0;
    while (model + 1 < floor_.models() && !(floor_.model(model) == mission.model)) ++model;
    return model;
  }

  // Who would be at the first stop soonest if nobody were in the way.
  std::uint32_t choose() const {
    std::vector<std::uint32_t> candidates = mission_.vehicles;
    for (std::uint32_t v = 0; mission_.vehicles.empty() && v < plan_.missions.size(); ++v) {
      if (!plan_.missions[v].path.empty()) candidates.push_back(v);
    }
    assert(!candidates.empty());
    if (candidates.size() == 1) return candidates.front();
    std::vector<geometry::Pose> ends;
    for (const std::uint32_t v : candidates) ends.push_back(plan_.missions[v].path.back().pose);
    const auto ways_m = floor_.planner(model_of(plan_.missions[candidates.front()]))
                            .least_ways_m(ends, mission_.stops.front().pose, options_.cancel);
    std::uint32_t best = candidates.front();
    double least_s = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      const milliseconds free = std::max(running_.times[candidates[k]].back().exit, running_.now);
      const double there_s =
          1e-3 * static_cast<double>(free.count()) + ways_m[k] / plan_.missions[candidates[k]].speed.max_mps;
      if (there_s >= least_s) continue;
      least_s = there_s;
      best = candidates[k];
    }
    return best;
  }

  std::vector<LegRequest> legs() const {
    std::vector<LegRequest> all;
    geometry::Pose at = own().path.back().pose;
    for (const NewStop& stop : mission_.stops) {
      all.push_back({model_of(own()), at, stop.pose});
      at = stop.pose;
    }
    return all;
  }

  // Paths on the floor, or on one where vehicles that stand in the way are obstacles.
  std::vector<PathAnswer> find_paths(const OccupancyGrid& map) {
    const auto begin = WallClock::now();
    const auto wanted = legs();
    const PathOptions options{
        .first_weight = options_.path_factor, .last_weight = options_.path_factor, .cancel = options_.cancel};
    std::vector<PathAnswer> answers;
    if (avoided_.empty()) {
      floor_.prepare(wanted, options);
      for (const LegRequest& leg : wanted) answers.push_back(floor_.leg(leg));
    } else {
      const PathPlanner planner = floor_.planner(wanted.front().model).on(map);
      answers.resize(wanted.size());
      internal::each_index(wanted.size(), floor_.threads(),
                           [&](std::size_t k) { answers[k] = floor_.plan(planner, wanted[k], options); });
    }
    added_.paths_ms += since_ms(begin);
    return answers;
  }

  // The mission of the vehicle with the new part behind the old one; nothing, with the reason, if there is
  // none.
  std::optional<VehicleMission> extend() {
    std::optional<OccupancyGrid> closed;
    if (!avoided_.empty()) {
      closed = floor_.map();
      for (const auto& area : avoided_) block(*closed, area);
    }
    const OccupancyGrid& map = closed ? *closed : floor_.map();
    const auto answers = find_paths(map);
    std::vector<const LatticePath*> paths;
    for (const PathAnswer& answer : answers) {
      if (!answer.path) {
        if (answer.end == PathEnd::Cancelled) {
          added_.verdict = Verdict::Cancelled;
          return std::nullopt;
        }
        // A detour that does not exist leaves the reason of before.
        if (avoided_.empty())
          refuse(answer.diagnostics.empty() ? "no path" : answer.diagnostics.front().message);
        return std::nullopt;
      }
      paths.push_back(&*answer.path);
    }
    const auto begin = WallClock::now();
    const geometry::Path added = internal::join_legs(paths);
    std::vector<Stop> stops = stops_of(paths);
    EnvelopeOptions envelope = options_.envelope;
    envelope.speed = own().speed;
    auto grown = grow_between_stands(map, own().model.footprint(), own().vehicle, added,
                                     internal::stands_of(stops), envelope);
    added_.envelopes_ms += since_ms(begin);
    if (!grown) {
      if (avoided_.empty()) refuse(grown.error().front().message);
      return std::nullopt;
    }
    VehicleMission next = own();
    next.path = added;
    next.stops = std::move(stops);
    next.grown = *std::move(grown);
    return internal::joined(own(), std::move(next));
  }

  std::vector<Stop> stops_of(const std::vector<const LatticePath*>& paths) const {
    std::vector<Stop> stops;
    std::size_t pose = 0;
    double arc_m = 0.0;
    std::uint32_t aboard = own().stops.empty() ? 0 : own().stops.back().aboard;
    for (std::size_t k = 0; k < mission_.stops.size(); ++k) {
      const NewStop& stop = mission_.stops[k];
      pose += paths[k]->poses.size() - 1;
      arc_m += paths[k]->length_m;
      if (stop.kind == StopKind::PickUp) aboard += stop.amount;
      if (stop.kind == StopKind::SetDown) aboard -= std::min(aboard, stop.amount);
      stops.push_back({stop.kind, stop.location, stop.goal, stop.amount, aboard, pose, arc_m, stop.service});
    }
    return stops;
  }

  // What has happened, what cannot be earlier, and who goes first where that is settled.
  std::vector<TemporalConstraint> facts(const VehicleMission& extended) const {
    std::vector<TemporalConstraint> all = plan_.constraints;
    const auto add = [&](const TimepointRef& at, milliseconds least, milliseconds most) {
      all.push_back({.name = "as it runs", .from = {}, .to = at, .distance = {least, most}});
    };
    for (std::uint32_t v = 0; v < running_.times.size(); ++v) {
      const VehicleTimes& times = running_.times[v];
      for (std::uint32_t k = 0; k < times.size(); ++k) {
        const bool leaves_later = v == added_.vehicle && k + 1 == times.size();
        const auto most = [&](milliseconds time) { return time < running_.now ? time : kNever; };
        add({{v, k}, Side::Entry}, times[k].entry, most(times[k].entry));
        if (leaves_later) {
          add({{v, k}, Side::Exit}, std::max(times[k].exit, running_.now), kNever);
        } else {
          add({{v, k}, Side::Exit}, times[k].exit, most(times[k].exit));
        }
      }
    }
    const auto begun = static_cast<std::uint32_t>(running_.times[added_.vehicle].size());
    for (std::uint32_t k = begun; k < extended.grown.envelope.polygons.size(); ++k) {
      add({{added_.vehicle, k}, Side::Entry}, running_.now, kNever);
    }
    for (const Precedence& settled : plan_.schedule.precedences) {
      all.push_back({.name = "settled order",
                     .from = TimepointRef{settled.first, Side::Exit},
                     .to = {settled.second, Side::Entry},
                     .distance = {milliseconds(0), kNever}});
    }
    return all;
  }

  bool order(VehicleMission extended) {
    const auto begin = WallClock::now();
    FleetPlan next{plan_.missions, facts(extended), {}};
    next.missions[added_.vehicle] = std::move(extended);
    next.schedule = schedule(envelopes_of(next), next.constraints,
                             {.mode = options_.mode, .time = options_.time, .cancel = options_.cancel});
    added_.verdict = next.schedule.verdict;
    added_.schedule_ms += since_ms(begin);
    if (added_.verdict == Verdict::Infeasible) {
      core_ = next.schedule.core;
      if (added_.reason.empty()) added_.reason = reason_of(next, settled_aside(core_), nullptr, {});
    }
    if (added_.verdict == Verdict::Scheduled) {
      added_.reason.clear();
      next.constraints = plan_.constraints;
      added_.plan = std::move(next);
    }
    return added_.verdict != Verdict::Infeasible;
  }

  // What runs is no news to anybody.
  Core settled_aside(Core core) const {
    std::erase_if(core.constraints, [&](std::uint32_t k) { return k >= plan_.constraints.size(); });
    return core;
  }

  // Places of vehicles that will not go away, of those that the last answer blames. False if there are no new
  // ones.
  bool avoid_more() {
    const std::size_t before = avoided_.size();
    for (const auto& section : core_.sections) {
      for (const SpatialPair& pair : section) {
        for (const PolygonRef at : {pair.a, pair.b}) {
          if (at.vehicle == added_.vehicle) continue;
          const auto& polygons = plan_.missions[at.vehicle].grown.envelope.polygons;
          if (at.polygon + 1 == polygons.size()) keep_out_of(at, polygons[at.polygon].area);
        }
      }
    }
    return avoided_.size() > before;
  }

  void keep_out_of(PolygonRef at, const geometry::ConvexPolygon& area) {
    if (std::ranges::find(avoided_from_, at) != avoided_from_.end()) return;
    const geometry::Footprint outline = own().model.footprint();
    bool mine = overlaps(footprint_at(own().path.back().pose, outline), area);
    for (const NewStop& stop : mission_.stops)
      mine = mine || overlaps(footprint_at(stop.pose, outline), area);
    if (mine) return;
    avoided_from_.push_back(at);
    avoided_.push_back(area);
  }

  void refuse(const std::string& why) {
    added_.verdict = Verdict::Infeasible;
    added_.reason = own().vehicle + ": " + why + "\n";
  }

  FleetFloor& floor_;
  const FleetPlan& plan_;
  const RunningPlan& running_;
  const NewMission& mission_;
  const AddOptions& options_;
  AddedMission added_;
  Core core_;
  std::vector<PolygonRef> avoided_from_;
  std::vector<geometry::ConvexPolygon> avoided_;
};

}  // namespace

AddedMission add_mission(FleetFloor& floor, const FleetPlan& plan, const RunningPlan& running,
                         const NewMission& mission, const AddOptions& options) {
  return Addition(floor, plan, running, mission, options).run();
}

}  // namespace stepwright::fleet
