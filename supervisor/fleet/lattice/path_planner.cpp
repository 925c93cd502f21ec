#include "supervisor/fleet/lattice/path_planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "supervisor/fleet/lattice/internal/lattice_search.h"

namespace stepwright::fleet {

namespace {

using internal::LatticePose;
using internal::LatticeSearch;
using internal::RoundEnd;

constexpr int kMostCellsPerStep = 8;
constexpr double kLargestWeight = 100.0;
constexpr double kSmallestStep = 0.01;
constexpr double kSmallestSample_m = 0.001;

int poses_along(const Segment& segment, double sample_m) {
  return static_cast<int>(std::ceil(segment.length_m / sample_m - 1e-9));
}

// Sampled at equal distances within each line and arc, both ends included: between two poses the curvature
// stays.
LatticePath sample(const PrimitiveSet& primitives, const GridFrame& frame, const LatticePose& start,
                   const std::vector<std::size_t>& way, double sample_m) {
  const double resolution_m = primitives.options().resolution_m;
  LatticePath path;
  GridVector at = start.vertex;
  const auto place = [&](const geometry::Pose& local, double arc_m, geometry::Travel travel) {
    path.poses.push_back({{frame.origin.x_m + resolution_m * at.x + local.x_m,
                           frame.origin.y_m + resolution_m * at.y + local.y_m, local.heading_rad},
                          arc_m,
                          travel});
  };
  const auto first = way.empty() ? geometry::Travel::Forward : primitives.all()[way.front()].travel;
  place({0.0, 0.0, heading_rad(start.heading)}, 0.0, first);
  for (const std::size_t index : way) {
    const MotionPrimitive& primitive = primitives.all()[index];
    path.marks.push_back({path.poses.size() - 1, index});
    double begun_m = 0.0;
    for (const Segment& segment : primitive.segments) {
      const int steps = poses_along(segment, sample_m);
      for (int k = 1; k <= steps; ++k) {
        const double arc_m = begun_m + segment.length_m * k / steps;
        place(pose_along(primitive, arc_m), path.length_m + arc_m, primitive.travel);
      }
      begun_m += segment.length_m;
    }
    at = at + primitive.end;
    path.length_m += primitive.length_m;
    path.cost_mm += primitive.cost_mm;
  }
  return path;
}

std::string name(const geometry::Pose& pose) {
  return fmt::format("({:.2f} m, {:.2f} m, {:.2f} rad)", pose.x_m, pose.y_m, pose.heading_rad);
}

// One question to a planner: checks the poses, searches round by round, and puts the answer together.
class Question {
 public:
  Question(const OccupancyGrid& map, const PrimitiveSet& primitives, const SweptCells& cells,
           const DistanceField& clearance)
      : map_(map), primitives_(primitives), cells_(cells), clearance_(clearance) {}

  std::int32_t columns() const { return map_.frame().columns / cells_.cells_per_step() + 1; }
  std::int32_t rows() const { return map_.frame().rows / cells_.cells_per_step() + 1; }

  // The nearest pose of the lattice, if the vehicle can stand there.
  std::optional<LatticePose> place(const geometry::Pose& pose, std::string_view which) {
    const GridFrame& frame = map_.frame();
    const double step_m = primitives_.options().resolution_m;
    const bool finite = std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.heading_rad);
    const double x = std::round((pose.x_m - frame.origin.x_m) / step_m);
    const double y = std::round((pose.y_m - frame.origin.y_m) / step_m);
    if (!finite || x < 0 || y < 0 || x >= columns() || y >= rows()) {
      refuse("F0302", fmt::format("the {} {} is off the map", which, name(pose)),
             fmt::format("the map reaches from ({:.2f} m, {:.2f} m) to ({:.2f} m, {:.2f} m)",
                         frame.origin.x_m, frame.origin.y_m, frame.corner({frame.columns, 0}).x_m,
                         frame.corner({0, frame.rows}).y_m));
      return std::nullopt;
    }
    const LatticePose placed{{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)},
                             nearest_heading(pose.heading_rad)};
    return check_stand(placed, pose, which) ? std::optional(placed) : std::nullopt;
  }

  void refuse(std::string code, std::string message, std::string hint = {}) {
    answer.diagnostics.push_back(
        {std::move(code), result::Severity::Error, {}, std::move(message), std::move(hint)});
  }

  void search(LatticeSearch& search, const LatticePose& start, const PathOptions& options);

  PathAnswer answer;

 private:
  bool check_stand(const LatticePose& placed, const geometry::Pose& pose, std::string_view which) {
    const int scale = cells_.cells_per_step();
    const Cell corner{placed.vertex.x * scale, placed.vertex.y * scale};
    const SweptMotion& stand = cells_.of_heading(placed.heading);
    if (SweptCells::free(map_, clearance_, stand, corner)) return true;
    for (const RowSpan& span : stand.spans) {
      for (std::int32_t column = span.first; column <= span.last; ++column) {
        const Cell cell{corner.column + column, corner.row + span.row};
        if (!map_.blocked(cell)) continue;
        const geometry::Point at = map_.frame().corner(cell);
        refuse("F0303",
               map_.contains(cell)
                   ? fmt::format("the {} {} is in collision with the obstacle at ({:.2f} m, {:.2f} m)", which,
                                 name(pose), at.x_m, at.y_m)
                   : fmt::format("at the {} {} the vehicle stands over the border of the map at "
                                 "({:.2f} m, {:.2f} m)",
                                 which, name(pose), at.x_m, at.y_m));
        return false;
      }
    }
    return true;
  }

  const OccupancyGrid& map_;
  const PrimitiveSet& primitives_;
  const SweptCells& cells_;
  const DistanceField& clearance_;
};

PathEnd to_path_end(RoundEnd end) {
  switch (end) {
    case RoundEnd::Solved:
      return PathEnd::Found;
    case RoundEnd::NoPath:
      return PathEnd::Unreachable;
    case RoundEnd::Deadline:
      return PathEnd::Deadline;
    case RoundEnd::Cancelled:
      return PathEnd::Cancelled;
  }
  return PathEnd::Unreachable;
}

void Question::search(LatticeSearch& search, const LatticePose& start, const PathOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  double weight = std::clamp(options.first_weight, 1.0, kLargestWeight);
  const double step = std::max(kSmallestStep, options.weight_step);
  while (true) {
    const RoundEnd end = search.run_round(weight);
    answer.end = to_path_end(end);
    answer.expanded = search.expanded();
    answer.peak_bytes = search.bytes();
    if (!search.solved()) return;
    LatticePath path =
        sample(primitives_, map_.frame(), start, search.way(), std::max(kSmallestSample_m, options.sample_m));
    const std::uint32_t bound = search.lower_bound_mm();
    answer.epsilon = path.cost_mm <= bound ? 1.0 : double(path.cost_mm) / bound;
    answer.improvements.push_back(
        {weight, path.cost_mm, answer.epsilon, answer.expanded, std::chrono::steady_clock::now() - begin});
    answer.path = std::move(path);
    if (end != RoundEnd::Solved || weight == 1.0 || answer.epsilon <= options.last_weight) return;
    // A round at the last weight may prove a little less where the estimate is not consistent.
    const double floor = weight > options.last_weight ? std::max(1.0, options.last_weight) : 1.0;
    weight = std::max(floor, std::min(weight, answer.epsilon) - step);
  }
}

}  // namespace

result::Result<PathPlanner> PathPlanner::create(const OccupancyGrid& map, const VehicleModel& vehicle,
                                                const PrimitiveSet& primitives, const HeuristicTable& table) {
  const double step_m = primitives.options().resolution_m;
  const double quotient = step_m / map.frame().resolution_m;
  const double whole = std::round(quotient);
  if (whole < 1 || whole > kMostCellsPerStep || std::abs(quotient - whole) > 1e-6) {
    return result::fail(
        "F0301", {},
        fmt::format("the map has cells of {} m; poses lie {} m apart", map.frame().resolution_m, step_m),
        fmt::format("the distance between poses is 1 to {} times the side of a cell", kMostCellsPerStep));
  }
  return PathPlanner(map, vehicle, primitives, table, static_cast<int>(whole));
}

PathPlanner::PathPlanner(const OccupancyGrid& map, const VehicleModel& vehicle,
                         const PrimitiveSet& primitives, const HeuristicTable& table, int cells_per_step)
    : map_(&map),
      vehicle_(vehicle),
      primitives_(&primitives),
      table_(&table),
      cells_(vehicle, primitives, cells_per_step),
      clearance_(map),
      detour_(detour_of(primitives)),
      length_detour_(length_detour_of(primitives)) {}

PathPlanner PathPlanner::on(const OccupancyGrid& map) const {
  assert(map.frame() == map_->frame());
  PathPlanner other(*this);
  other.map_ = &map;
  other.clearance_ = DistanceField(map);
  return other;
}

std::vector<double> PathPlanner::least_ways_m(std::span<const geometry::Pose> from, const geometry::Pose& to,
                                              const std::atomic<bool>* cancel) const {
  const GridFrame& frame = map_->frame();
  const int scale = cells_.cells_per_step();
  const std::int32_t columns = frame.columns / scale + 1;
  const std::int32_t rows = frame.rows / scale + 1;
  const double step_m = primitives_->options().resolution_m;
  const auto nearest = [&](const geometry::Pose& pose) {
    const auto on = [&](double at_m, std::int32_t count) {
      return static_cast<std::int32_t>(std::clamp(std::round(at_m / step_m), 0.0, count - 1.0));
    };
    return GridVector{on(pose.x_m - frame.origin.x_m, columns), on(pose.y_m - frame.origin.y_m, rows)};
  };
  // A start that is nowhere: distances of the whole floor.
  const ObstacleDistances around(clearance_, {.goal = nearest(to),
                                              .start = {-1, -1},
                                              .columns = columns,
                                              .rows = rows,
                                              .cells_per_step = scale,
                                              .resolution_m = step_m,
                                              .inscribed_radius_m = vehicle_.inscribed_radius_m(),
                                              .detour = length_detour_,
                                              .cancel = cancel});
  std::vector<double> ways_m;
  for (const geometry::Pose& pose : from) {
    const GridVector straight = nearest(pose) - nearest(to);
    const double around_m = around.lower_bound_mm(nearest(pose)) / 1000.0;
    const bool known = !around.cancelled();
    ways_m.push_back(known ? std::max(around_m, step_m * std::hypot(straight.x, straight.y)) : 0.0);
  }
  return ways_m;
}

double PathPlanner::most_poses_per_m(double sample_m) const {
  double most = 0.0;
  for (const MotionPrimitive& primitive : primitives_->all()) {
    int poses = 0;
    for (const Segment& segment : primitive.segments) poses += poses_along(segment, sample_m);
    most = std::max(most, poses / primitive.length_m);
  }
  return most;
}

FreeMotions PathPlanner::free_motions(unsigned threads) const {
  return FreeMotions(*map_, clearance_, *primitives_, cells_, threads);
}

std::optional<CostToGo> PathPlanner::cost_to_go(const FreeMotions& motions,
                                                const geometry::Pose& goal) const {
  Question question(*map_, *primitives_, cells_, clearance_);
  const auto to = question.place(goal, "goal");
  if (!to) return std::nullopt;
  return CostToGo(motions, *primitives_, to->vertex, to->heading);
}

std::optional<Approaches> PathPlanner::approaches(const geometry::Pose& goal, std::size_t most) const {
  Question question(*map_, *primitives_, cells_, clearance_);
  const auto to = question.place(goal, "goal");
  if (!to) return std::nullopt;
  return Approaches::find(*map_, clearance_, *primitives_, cells_, to->vertex, to->heading, most);
}

std::size_t PathPlanner::visit_reachable(const geometry::Pose& start, std::size_t most,
                                         const TakePose& take) const {
  Question question(*map_, *primitives_, cells_, clearance_);
  const auto from = question.place(start, "start");
  if (!from) return 0;
  return fleet::visit_reachable(*map_, clearance_, *primitives_, cells_, from->vertex, from->heading, most,
                                take);
}

PathAnswer PathPlanner::plan(const geometry::Pose& start, const geometry::Pose& goal,
                             const PathOptions& options, const CostToGo* to_go) const {
  Question question(*map_, *primitives_, cells_, clearance_);
  const auto from = question.place(start, "start");
  const auto to = question.place(goal, "goal");
  if (!from || !to) {
    question.answer.end = PathEnd::Refused;
    return std::move(question.answer);
  }
  internal::SearchFloor floor{*map_,   clearance_, *primitives_,       cells_,         *table_,
                              nullptr, nullptr,    question.columns(), question.rows()};
  // Where it knows of no way the plain search says why.
  if (to_go != nullptr && options.heuristic == Heuristic::Combined &&
      to_go->lower_bound_mm(from->vertex, from->heading) != CostToGo::kNoWay)
    floor.to_go = to_go;
  // A short search with costs to go needs nothing else. A long one has come to something that was not there
  // when they were worked out: what is around that, distances on this map know.
  std::optional<ObstacleDistances> around;
  if (floor.to_go == nullptr || options.most_expanded == 0) {
    around.emplace(clearance_, ObstacleQuestion{.goal = to->vertex,
                                                .start = from->vertex,
                                                .columns = question.columns(),
                                                .rows = question.rows(),
                                                .cells_per_step = cells_.cells_per_step(),
                                                .resolution_m = primitives_->options().resolution_m,
                                                .inscribed_radius_m = vehicle_.inscribed_radius_m(),
                                                .detour = detour_,
                                                .cancel = options.cancel});
    if (around->cancelled()) {
      question.answer.end = PathEnd::Cancelled;
      return std::move(question.answer);
    }
    floor.around = &*around;
    if (around->unreachable()) {
      question.answer.end = PathEnd::Unreachable;
      question.refuse("F0304",
                      fmt::format("no passage from {} to {} is wide enough for the vehicle's {:.2f} m",
                                  name(start), name(goal), vehicle_.width_m));
      return std::move(question.answer);
    }
  }
  LatticeSearch search(floor, *from, *to, options);
  question.search(search, *from, options);
  if (question.answer.end == PathEnd::Unreachable) {
    question.refuse(
        "F0305",
        fmt::format("none of the {} poses that can be reached from {} is {}", search.expanded(), name(start),
                    name(goal)),
        fmt::format("is there room to turn with a radius of {:.2f} m?", vehicle_.min_turning_radius_m));
  }
  return std::move(question.answer);
}

PathAnswer PathPlanner::plan_guided(const geometry::Pose& start, const geometry::Pose& goal,
                                    const PathOptions& options, const CostToGo& to_go) const {
  constexpr double kWeight = 1.02;  // more than the rounding of estimates
  constexpr std::uint64_t kExpansions = 4000;
  PathOptions straight = options;
  straight.first_weight = std::min(kWeight, options.first_weight);
  straight.most_expanded =
      options.most_expanded == 0 ? kExpansions : std::min(kExpansions, options.most_expanded);
  PathAnswer answer = plan(start, goal, straight, &to_go);
  const bool gave_up = answer.end == PathEnd::Deadline && answer.expanded >= straight.most_expanded;
  return gave_up ? plan(start, goal, options, &to_go) : answer;
}

}  // namespace stepwright::fleet
