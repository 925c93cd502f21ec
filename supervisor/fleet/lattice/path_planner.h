#pragma once

// Paths of a vehicle on a map: A* and ARA* over a state lattice (Pivtoraiko, Knepper, Kelly 2009; Pecora and
// Cirillo 2012, "Trajectory Planning").
//
// Any number of threads may plan with one planner at the same time. Map, primitives and table must outlive
// it. Vertices of the lattice lie on corners of the map's cells; poses are taken to the nearest vertex and
// heading. A path is collision-free for the exact outline: swept cells hold more, never less. The same
// question gives the same path unless time ends or somebody stops it.
//
//   const PrimitiveSet primitives(vehicle, {});
//   const auto table = HeuristicTable::load_or_build(primitives, {}, file).table;
//   const auto planner = PathPlanner::create(map, vehicle, primitives, table);
//   const PathAnswer answer = planner->plan({5, 5, 0}, {60, 40, 1.57}, {.first_weight = 3.0});

#include <atomic>
#include <optional>
#include <span>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/fleet/lattice/approaches.h"
#include "supervisor/fleet/lattice/cost_to_go.h"
#include "supervisor/fleet/lattice/heuristic_table.h"
#include "supervisor/fleet/lattice/lattice_path.h"
#include "supervisor/fleet/lattice/obstacle_distances.h"
#include "supervisor/fleet/lattice/reachable.h"
#include "supervisor/fleet/lattice/swept_cells.h"

namespace stepwright::fleet {

class PathPlanner {
 public:
  // F0301: the distance between vertices is not 1 to 8 times the side of the map's cells.
  [[nodiscard]] static result::Result<PathPlanner> create(const OccupancyGrid& map,
                                                          const VehicleModel& vehicle,
                                                          const PrimitiveSet& primitives,
                                                          const HeuristicTable& table);

  // The same vehicle on another map with the same cells, for a fraction of the cost: with some places closed,
  // say. The map must outlive the new planner.
  PathPlanner on(const OccupancyGrid& map) const;

  // A length in metres that no path on the lattice from each of these places to `to` is shorter than,
  // whatever it costs. Takes far less time than a path. It knows nothing of headings, and may say a number
  // where there is no path. All are 0 where it was cancelled.
  std::vector<double> least_ways_m(std::span<const geometry::Pose> from, const geometry::Pose& to,
                                   const std::atomic<bool>* cancel = nullptr) const;

  // No path has more poses for a metre of its way, at sample_m of PathOptions.
  double most_poses_per_m(double sample_m = kPathSample_m) const;

  // All that can be driven on its map, and what it costs from everywhere to a pose: estimates for plan(),
  // here and in planners for maps that have more obstacles. Nothing for a pose off the map.
  FreeMotions free_motions(unsigned threads) const;
  std::optional<CostToGo> cost_to_go(const FreeMotions& motions, const geometry::Pose& goal) const;

  // From where the goal can be reached, if that are no more than so many poses of the lattice; nothing as
  // well for a goal off the map or in collision.
  std::optional<Approaches> approaches(const geometry::Pose& goal, std::size_t most) const;

  // Where the vehicle can drive from there, cheapest first; see reachable.h. Nowhere from a pose off the map
  // or in collision.
  std::size_t visit_reachable(const geometry::Pose& start, std::size_t most, const TakePose& take) const;

  // `to_go`: of this goal, if there is one.
  // Diagnostics: F0302 a pose off the map, F0303 a pose in collision (and with which cell), F0304 no passage
  // wide enough, F0305 no path on the lattice.
  PathAnswer plan(const geometry::Pose& start, const geometry::Pose& goal, const PathOptions& options = {},
                  const CostToGo* to_go = nullptr) const;
  // With the costs of all ways to the goal a search goes straight to the best one, unless what its map closes
  // lies on it: nearly without a weight first, and as `options` say where that leads nowhere soon.
  PathAnswer plan_guided(const geometry::Pose& start, const geometry::Pose& goal, const PathOptions& options,
                         const CostToGo& to_go) const;

 private:
  PathPlanner(const OccupancyGrid& map, const VehicleModel& vehicle, const PrimitiveSet& primitives,
              const HeuristicTable& table, int cells_per_step);

  const OccupancyGrid* map_;
  VehicleModel vehicle_;
  const PrimitiveSet* primitives_;
  const HeuristicTable* table_;
  SweptCells cells_;
  DistanceField clearance_;
  std::uint32_t detour_;
  std::uint32_t length_detour_;
};

}  // namespace stepwright::fleet
