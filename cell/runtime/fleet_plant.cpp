#include "cell/runtime/fleet_plant.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "supervisor/map/map_file.h"

namespace stepwright::cell_runtime {
namespace {

using fleet::Cell;
using fleet::OccupancyGrid;

constexpr double kBorder_m = 1.0;  // thickness of the wall around the map

double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

assemblies::BlockParameters block(geometry::Point low, geometry::Point high) {
  return {{{high.x_m - low.x_m, high.y_m - low.y_m}},
          {{0.5 * (low.x_m + high.x_m), 0.5 * (low.y_m + high.y_m)}, 0.0}};
}

// Cells that are blocked and in no rectangle yet.
class Remaining {
 public:
  explicit Remaining(const OccupancyGrid& grid) : grid_(grid), taken_(grid.frame()) {}

  bool has(Cell cell) const { return grid_.contains(cell) && grid_.blocked(cell) && !taken_.blocked(cell); }
  // The far corner of the rectangle that begins at `first`.
  Cell take(Cell first) {
    Cell last = first;
    while (has({last.column + 1, first.row})) ++last.column;
    while (has_row(last.row + 1, first.column, last.column)) ++last.row;
    for (std::int32_t row = first.row; row <= last.row; ++row) {
      for (std::int32_t column = first.column; column <= last.column; ++column)
        taken_.set({column, row}, true);
    }
    return last;
  }

 private:
  bool has_row(std::int32_t row, std::int32_t first, std::int32_t last) const {
    for (std::int32_t column = first; column <= last; ++column) {
      if (!has({column, row})) return false;
    }
    return true;
  }

  const OccupancyGrid& grid_;
  OccupancyGrid taken_;
};

void add_border(const OccupancyGrid& grid, std::vector<assemblies::BlockParameters>& walls) {
  const fleet::GridFrame& frame = grid.frame();
  const geometry::Point low = frame.corner({0, 0});
  const geometry::Point high = frame.corner({frame.columns, frame.rows});
  const double b = kBorder_m;
  walls.push_back(block({low.x_m - b, low.y_m - b}, {high.x_m + b, low.y_m}));
  walls.push_back(block({low.x_m - b, high.y_m}, {high.x_m + b, high.y_m + b}));
  walls.push_back(block({low.x_m - b, low.y_m}, {low.x_m, high.y_m}));
  walls.push_back(block({high.x_m, low.y_m}, {high.x_m + b, high.y_m}));
}

// What the shape covers of the map is free, and all of it is on the map.
bool is_free(const OccupancyGrid& grid, const geometry::ConvexPolygon& shape) {
  const Cell low = grid.frame().cell_at(shape.bounds().low);
  const Cell high = grid.frame().cell_at(shape.bounds().high);
  for (std::int32_t row = low.row; row <= high.row; ++row) {
    for (std::int32_t column = low.column; column <= high.column; ++column) {
      const bool blocked = grid.blocked({column, row});
      if (blocked && geometry::overlaps(shape, fleet::cell_square(grid.frame(), {column, row}))) return false;
    }
  }
  return true;
}

geometry::Pose pose_of(const config::PlaceConfig& place) {
  return {place.x_m, place.y_m, radians(place.heading_deg)};
}

// What stands where at the start.
class StandCheck {
 public:
  explicit StandCheck(const std::optional<OccupancyGrid>& grid) : grid_(grid) {}

  void check(const std::string& name, const config::PlaceConfig& place, const geometry::Footprint& footprint,
             bool apart) {
    const auto shape = geometry::footprint_at(pose_of(place), footprint);
    if (grid_ && !is_free(*grid_, shape)) {
      report(place, name + " stands in a wall or outside of the map", "choose a free place of the map");
    }
    if (!apart) return;
    for (const auto& [other, other_shape] : standing_) {
      if (geometry::overlaps(shape, other_shape)) {
        report(place, name + " stands in " + other, "vehicles need places of their own");
      }
    }
    standing_.emplace_back(name, shape);
  }
  result::Diagnostics take() { return std::move(problems_); }

 private:
  void report(const config::PlaceConfig& place, std::string message, std::string hint) {
    result::Diagnostic problem;
    problem.code = "C0322";
    problem.where = place.where;
    problem.message = std::move(message);
    problem.hint = std::move(hint);
    problems_.push_back(std::move(problem));
  }

  const std::optional<OccupancyGrid>& grid_;
  std::vector<std::pair<std::string, geometry::ConvexPolygon>> standing_;
  result::Diagnostics problems_;
};

result::Diagnostics check_places(const config::FleetPlantConfig& fleet,
                                 const std::optional<OccupancyGrid>& grid,
                                 const assemblies::ForkliftBody& body) {
  StandCheck check(grid);
  for (std::size_t k = 0; k < fleet.vehicles.size(); ++k) {
    check.check("vehicle v" + std::to_string(k + 1), fleet.vehicles[k],
                {body.front_m, body.rear_m, 0.5 * body.width_m}, true);
  }
  for (std::size_t k = 0; k < fleet.pallets.size(); ++k) {
    constexpr double kLength_m = assemblies::kPalletLength_m;
    check.check("pallet p" + std::to_string(k + 1), fleet.pallets[k].place,
                {0.5 * kLength_m, 0.5 * kLength_m, 0.5 * assemblies::kPalletWidth_m}, false);
  }
  return check.take();
}

}  // namespace

std::vector<assemblies::BlockParameters> walls_of(const OccupancyGrid& grid) {
  std::vector<assemblies::BlockParameters> walls;
  Remaining remaining(grid);
  for (std::int32_t row = 0; row < grid.frame().rows; ++row) {
    for (std::int32_t column = 0; column < grid.frame().columns; ++column) {
      if (!remaining.has({column, row})) continue;
      const Cell last = remaining.take({column, row});
      walls.push_back(
          block(grid.frame().corner({column, row}), grid.frame().corner({last.column + 1, last.row + 1})));
    }
  }
  add_border(grid, walls);
  return walls;
}

result::Result<assemblies::FleetParameters> fleet_parameters(const config::PlantConfig& plant) {
  std::optional<OccupancyGrid> grid;
  if (!plant.fleet.map.empty()) {
    auto read = fleet::read_map(plant.fleet.map);
    if (!read) return result::forward(read);
    grid = std::move(*read);
  }
  assemblies::FleetParameters parameters;
  parameters.seed = plant.seed;
  parameters.lift_s = plant.fleet.lift_s;
  if (!plant.uncertainty) parameters.noise = assemblies::FleetNoise::none();
  if (auto wrong = check_places(plant.fleet, grid, parameters.forklift.body); !wrong.empty()) {
    return tl::unexpected(std::move(wrong));
  }
  if (grid) parameters.walls = walls_of(*grid);
  for (const config::PlaceConfig& place : plant.fleet.vehicles) {
    parameters.starts.push_back({place.x_m, place.y_m, radians(place.heading_deg)});
  }
  const auto body_pose = [](const config::PlaceConfig& place) {
    return body2d::Pose{{place.x_m, place.y_m}, radians(place.heading_deg)};
  };
  for (const config::PalletConfig& pallet : plant.fleet.pallets) {
    parameters.pallets.push_back({body_pose(pallet.place), pallet.load_kg});
  }
  for (const config::BlockageConfig& blockage : plant.fleet.blockages) {
    parameters.blockages.push_back({{{blockage.length_m, blockage.width_m}}, body_pose(blockage.place)});
  }
  return parameters;
}

}  // namespace stepwright::cell_runtime
