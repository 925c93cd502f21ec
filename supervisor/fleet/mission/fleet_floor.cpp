#include "supervisor/fleet/mission/fleet_floor.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <system_error>
#include <utility>

#include "supervisor/fleet/mission/internal/parallel.h"

namespace stepwright::fleet {

namespace {

constexpr std::size_t kMostKnown = 20'000;
constexpr std::size_t kNameBytes = 8;

std::string hex(const Digest& digest) {
  std::string text;
  for (std::size_t k = 0; k < kNameBytes; ++k) text += fmt::format("{:02x}", digest[k]);
  return text;
}

// Whether all obstacles of the other one are in this map too.
bool holds_all_of(const OccupancyGrid& map, const OccupancyGrid& other) {
  for (std::int32_t row = 0; row < map.frame().rows; ++row) {
    for (std::int32_t column = 0; column < map.frame().columns; ++column)
      if (other.blocked({column, row}) && !map.blocked({column, row})) return false;
  }
  return true;
}

}  // namespace

FleetFloor::Model::Model(const OccupancyGrid& map, const VehicleModel& of, HeuristicTable loaded,
                         PrimitiveSet made)
    : model(of),
      primitives(std::move(made)),
      table(std::move(loaded)),
      planner(PathPlanner::create(map, model, primitives, table).value()) {}

FleetFloor::FleetFloor(const OccupancyGrid& map, const FloorOptions& options)
    : options_(options), map_(std::make_unique<OccupancyGrid>(map)) {}

result::Result<FleetFloor> FleetFloor::create(const OccupancyGrid& map, std::span<const VehicleModel> models,
                                              const FloorOptions& options) {
  const double cells = LatticeOptions{}.resolution_m / map.frame().resolution_m;
  if (std::abs(cells - std::round(cells)) > 1e-6 || cells < 0.5 || cells > 8.5) {
    return result::fail("F0301", {},
                        fmt::format("the map has cells of {} m, which do not divide the {} m between poses",
                                    map.frame().resolution_m, LatticeOptions{}.resolution_m));
  }
  FleetFloor floor(map, options);
  for (const VehicleModel& model : models) floor.add(model);
  return floor;
}

void FleetFloor::add(const VehicleModel& model) {
  PrimitiveSet primitives(model, {});
  const TableOptions table{.range_m = options_.table_range_m,
                           .margin_m = options_.table_margin_m,
                           .threads = options_.threads,
                           .cancel = options_.cancel};
  if (options_.table_folder.empty()) {
    auto built = HeuristicTable::build(primitives, table);
    models_.push_back(std::make_unique<Model>(*map_, model, std::move(built), std::move(primitives)));
    return;
  }
  std::error_code ignored;  // what cannot be written is said below
  std::filesystem::create_directories(options_.table_folder, ignored);
  auto loaded = HeuristicTable::load_or_build(primitives, table,
                                              options_.table_folder / (hex(primitives.digest()) + ".table"));
  // That there was none is no news.
  if (loaded.unwritten) notes_.push_back(loaded.note);
  models_.push_back(std::make_unique<Model>(*map_, model, std::move(loaded.table), std::move(primitives)));
}

void FleetFloor::set_map(const OccupancyGrid& map) {
  assert(map.frame() == map_->frame());
  *map_ = map;
  for (auto& model : models_) {
    model->planner = model->planner.on(*map_);
    if (!model->motions || holds_all_of(*map_, *model->motions_floor)) continue;
    model->costs_to_go.clear();
    model->motions.reset();
  }
  known_.clear();
}

// Poses are taken to the nearest of the lattice.
FleetFloor::Place FleetFloor::place_of(const geometry::Pose& pose) const {
  const double step_m = LatticeOptions{}.resolution_m;
  const geometry::Point origin = map_->frame().origin;
  return {std::llround((pose.x_m - origin.x_m) / step_m), std::llround((pose.y_m - origin.y_m) / step_m),
          nearest_heading(pose.heading_rad)};
}

FleetFloor::Key FleetFloor::key_of(const LegRequest& leg) const {
  return {leg.model, place_of(leg.from), place_of(leg.to)};
}

void FleetFloor::prepare_goals(std::size_t model, std::span<const geometry::Pose> goals) {
  Model& of = *models_[model];
  if (!of.motions) {
    of.motions = of.planner.free_motions(options_.threads);
    of.motions_floor = *map_;
  }
  std::vector<std::optional<CostToGo>> made(goals.size());
  internal::each_index(goals.size(), options_.threads, [&](std::size_t k) {
    if (!of.costs_to_go.contains(place_of(goals[k]))) made[k] = of.planner.cost_to_go(*of.motions, goals[k]);
  });
  for (std::size_t k = 0; k < goals.size(); ++k) {
    if (made[k]) of.costs_to_go.emplace(place_of(goals[k]), *std::move(made[k]));
  }
}

std::size_t FleetFloor::prepared_goals() const {
  std::size_t count = 0;
  for (const auto& model : models_) count += model->costs_to_go.size();
  return count;
}

PathAnswer FleetFloor::plan(const LegRequest& leg, const PathOptions& options) const {
  return plan(models_[leg.model]->planner, leg, options);
}

PathAnswer FleetFloor::plan(const PathPlanner& planner, const LegRequest& leg,
                            const PathOptions& options) const {
  const auto& known = models_[leg.model]->costs_to_go;
  const auto to_go = known.find(place_of(leg.to));
  return to_go == known.end() ? planner.plan(leg.from, leg.to, options)
                              : planner.plan_guided(leg.from, leg.to, options, to_go->second);
}

void FleetFloor::prepare(std::span<const LegRequest> legs, const PathOptions& options) {
  if (known_.size() + legs.size() > kMostKnown) known_.clear();
  std::vector<std::pair<const LegRequest*, PathAnswer*>> missing;
  for (const LegRequest& leg : legs) {
    const auto [at, fresh] = known_.try_emplace(key_of(leg));
    PathAnswer& answer = at->second;
    const bool good = answer.end == PathEnd::Found && answer.epsilon <= options.last_weight;
    const bool none = answer.end == PathEnd::Refused || (answer.end == PathEnd::Unreachable && !fresh);
    if (good || none) continue;
    // Until it is answered; that another request of this call asks for the same is seen by it.
    answer.end = PathEnd::Refused;
    missing.emplace_back(&leg, &answer);
  }
  internal::each_index(missing.size(), options_.threads, [&](std::size_t k) {
    const auto [leg, answer] = missing[k];
    *answer = plan(*leg, options);
  });
  searches_ += missing.size();
}

const PathAnswer& FleetFloor::leg(const LegRequest& leg) const {
  return known_.at(key_of(leg));
}

const PathAnswer* FleetFloor::find(const LegRequest& leg) const {
  const auto found = known_.find(key_of(leg));
  return found == known_.end() ? nullptr : &found->second;
}

}  // namespace stepwright::fleet
