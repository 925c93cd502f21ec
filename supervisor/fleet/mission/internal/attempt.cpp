#include "supervisor/fleet/mission/internal/attempt.h"

#include <algorithm>

#include "supervisor/fleet/mission/internal/moments.h"

namespace stepwright::fleet::internal {

bool used_up(const SearchWork& work, const FleetOptions& options) {
  return (options.conflicts > 0 && work.conflicts >= options.conflicts) ||
         (options.expansions > 0 && work.expanded >= options.expansions);
}

bool Attempt::over() const {
  return used_up(work, options) || (options.cancel != nullptr && options.cancel->load()) ||
         (limited && std::chrono::steady_clock::now() >= until);
}

Schedule Attempt::schedule_of(const std::vector<Route>& stops,
                              const std::vector<VehicleMission>& missions) const {
  const auto mapped = map_constraints(problem, stops, missions);
  std::vector<TrajectoryEnvelope> envelopes;
  for (const VehicleMission& mission : missions) envelopes.push_back(mission.grown.envelope);
  ScheduleOptions asked{.mode = options.mode, .cancel = options.cancel};
  if (options.conflicts > 0)
    asked.conflicts =
        std::max<std::uint64_t>(1, options.conflicts - std::min(work.conflicts, options.conflicts));
  if (limited) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
    asked.time = std::max(left, std::chrono::milliseconds(1));
  }
  Schedule made = schedule(envelopes, mapped.constraints, asked);
  work.conflicts += made.figures.conflicts + made.figures.explain_conflicts;
  return made;
}

std::optional<std::vector<LatticePath>> Attempt::paths_through(const MissionProblem& places,
                                                               const geometry::Pose& from, const Route& stops,
                                                               const PathPlanner& planner,
                                                               PathOptions asked) const {
  if (limited) asked.deadline = until;
  asked.cancel = options.cancel;
  std::vector<LatticePath> paths;
  geometry::Pose at = from;
  for (const RouteStop& stop : stops) {
    const geometry::Pose& next = places.locations[stop.location].pose;
    PathAnswer answer = planner.plan(at, next, asked);
    work.expanded += answer.expanded;
    if (!answer.path) return std::nullopt;
    paths.push_back(*std::move(answer.path));
    at = next;
  }
  return paths;
}

double length_m(const VehicleMission& mission) {
  return mission.path.empty() ? 0.0 : mission.path.back().arc_m;
}

std::vector<const LatticePath*> borrowed(const std::vector<LatticePath>& paths) {
  std::vector<const LatticePath*> all;
  for (const LatticePath& path : paths) all.push_back(&path);
  return all;
}

}  // namespace stepwright::fleet::internal
