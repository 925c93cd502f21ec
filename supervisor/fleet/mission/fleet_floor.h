#pragma once

// A floor and the vehicles that drive on it, prepared for finding paths: primitives, look-up tables, swept
// cells for each model, and the paths that were found.
//
// Made once for a map; serves any number of problems and new missions. One thread at a time; works on several
// by itself. It holds the map by itself.
//
//   auto floor = FleetFloor::create(problem.map, models, {.table_folder = cache});
//   floor->prepare(legs, {});
//   if (const auto& path = floor->leg(legs[0]).path) ...

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/fleet/lattice/path_planner.h"

namespace stepwright::fleet {

struct FloorOptions {
  std::filesystem::path table_folder;  // look-up tables are kept there; empty: they are built each time
  double table_range_m = 10.0;
  double table_margin_m = 8.0;
  unsigned threads = 2;
  // Tables are left unfinished once this has become true: plan_fleet with the same flag is cancelled at once.
  // Not owned; may be null.
  const std::atomic<bool>* cancel = nullptr;
};

// A way of one model from pose to pose.
struct LegRequest {
  std::size_t model = 0;
  geometry::Pose from;
  geometry::Pose to;
};

class FleetFloor {
 public:
  // F0301: cells of the map do not fit the lattice. Models are those that `check` accepts.
  [[nodiscard]] static result::Result<FleetFloor> create(const OccupancyGrid& map,
                                                         std::span<const VehicleModel> models,
                                                         const FloorOptions& options);

  const OccupancyGrid& map() const { return *map_; }
  std::size_t models() const { return models_.size(); }
  const VehicleModel& model(std::size_t index) const { return models_[index]->model; }
  // Any number of threads may plan with it.
  const PathPlanner& planner(std::size_t model) const { return models_[model]->planner; }
  // Other cells are free and blocked from here on; paths are forgotten, so that what is planned does not
  // depend on what was planned before. What ways cost is forgotten too where a cell is free that was not when
  // it was worked out: it would be no lower bound. Requires the frame of the map so far.
  void set_map(const OccupancyGrid& map);
  unsigned threads() const { return options_.threads; }
  // Tables that could not be kept.
  const std::vector<std::string>& notes() const { return notes_; }

  // Works out what it costs a model to drive to these places from everywhere, in parallel: some tenths of a
  // second each, kept as long as the floor. Ways to them then take about a millisecond, around obstacles too.
  // Places off the map are left out.
  void prepare_goals(std::size_t model, std::span<const geometry::Pose> goals);
  // Pairs of a model and a place that are prepared.
  std::size_t prepared_goals() const;
  // One way, with what is known of its goal, on the floor's map or by a planner for one that has more
  // obstacles.
  PathAnswer plan(const LegRequest& leg, const PathOptions& options) const;
  PathAnswer plan(const PathPlanner& planner, const LegRequest& leg, const PathOptions& options) const;

  // Finds the paths that are not known yet, or not as good as `options` ask for, in parallel.
  void prepare(std::span<const LegRequest> legs, const PathOptions& options);
  // Requires that it was prepared. Stays where it is until the next `prepare`.
  const PathAnswer& leg(const LegRequest& leg) const;
  // The same; nullptr if it was not prepared.
  const PathAnswer* find(const LegRequest& leg) const;
  std::size_t searches() const { return searches_; }

 private:
  using Place = std::tuple<std::int64_t, std::int64_t, int>;  // of the lattice
  using Key = std::tuple<std::size_t, Place, Place>;          // model, start, goal
  struct Model {
    Model(const OccupancyGrid& map, const VehicleModel& of, HeuristicTable loaded, PrimitiveSet made);

    VehicleModel model;
    PrimitiveSet primitives;
    HeuristicTable table;
    PathPlanner planner;
    std::optional<FreeMotions> motions;          // once a goal was prepared
    std::optional<OccupancyGrid> motions_floor;  // on which they are free
    std::map<Place, CostToGo> costs_to_go;
  };

  FleetFloor(const OccupancyGrid& map, const FloorOptions& options);
  void add(const VehicleModel& model);
  Place place_of(const geometry::Pose& pose) const;
  Key key_of(const LegRequest& leg) const;

  FloorOptions options_;
  std::unique_ptr<OccupancyGrid> map_;          // planners point to it
  std::vector<std::unique_ptr<Model>> models_;  // and to these
  std::vector<std::string> notes_;
  std::map<Key, PathAnswer> known_;
  std::size_t searches_ = 0;
};

}  // namespace stepwright::fleet
