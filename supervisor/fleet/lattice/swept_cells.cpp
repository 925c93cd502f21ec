#include "supervisor/fleet/lattice/swept_cells.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>
#include <span>

namespace stepwright::fleet {

namespace {

constexpr double kClearance_m = 0.005;    // kept from every cell that is not in the set
constexpr double kFarthestStep_m = 0.02;  // no point of the outline moves further between two samples

// A row-wise picture of the cells around a vertex.
class CellPicture {
 public:
  explicit CellPicture(int half_width) : half_(half_width), cells_(side() * side(), false) {}

  void add(std::span<const RowSpan> spans) {
    for (const RowSpan& span : spans) {
      for (int column = span.first; column <= span.last; ++column) at({column, span.row}) = true;
    }
  }

  // Turned by right angles about the vertex, and with the vertex `origin` at its middle instead.
  CellPicture seen_from(Cell origin, int quarters) const {
    CellPicture result(half_);
    for (int row = -half_; row < half_; ++row) {
      for (int column = -half_; column < half_; ++column) {
        if (!at({column, row})) continue;
        Cell cell{column - origin.column, row - origin.row};
        for (int k = 0; k < quarters; ++k) cell = {-cell.row - 1, cell.column};
        result.at(cell) = true;
      }
    }
    return result;
  }

  SweptMotion to_motion(double cell_m) const {
    SweptMotion motion;
    int farthest = 0;  // squared, in cells, from the vertex to the outer corner of a cell
    for (int row = -half_; row < half_; ++row) {
      for (int column = -half_; column < half_; ++column) {
        if (!at({column, row})) continue;
        const int x = std::max(column + 1, -column);
        const int y = std::max(row + 1, -row);
        farthest = std::max(farthest, x * x + y * y);
        const bool continues =
            !motion.spans.empty() && motion.spans.back().row == row && motion.spans.back().last == column - 1;
        if (continues) {
          motion.spans.back().last = column;
        } else {
          motion.spans.push_back({row, column, column});
        }
      }
    }
    constexpr double kRounding_m = 1e-4;  // of distances in single precision
    motion.reach_m = static_cast<float>(cell_m * std::sqrt(farthest) + kRounding_m);
    return motion;
  }

 private:
  std::size_t side() const { return 2 * static_cast<std::size_t>(half_); }
  std::size_t index(Cell cell) const {
    assert(std::abs(cell.column) <= half_ && std::abs(cell.row) <= half_);
    return static_cast<std::size_t>(cell.row + half_) * side() +
           static_cast<std::size_t>(cell.column + half_);
  }
  std::vector<bool>::reference at(Cell cell) { return cells_[index(cell)]; }
  bool at(Cell cell) const { return cells_[index(cell)]; }

  int half_;
  std::vector<bool> cells_;
};

geometry::Footprint grown(const geometry::Footprint& footprint, double by_m) {
  return {footprint.front_m + by_m, footprint.rear_m + by_m, footprint.half_width_m + by_m};
}

class Sweeper {
 public:
  Sweeper(const VehicleModel& vehicle, double cell_m, double longest_m)
      : vehicle_(vehicle), frame_{.resolution_m = cell_m, .origin = {}, .columns = 1, .rows = 1} {
    half_ = static_cast<int>(std::ceil((vehicle.circumscribed_radius_m() + longest_m + 0.1) / cell_m)) + 1;
  }

  CellPicture stand(int heading) const {
    CellPicture picture(half_);
    picture.add(cells_at({0.0, 0.0, heading_rad(heading)}, kClearance_m));
    return picture;
  }

  // Between two samples no point is farther from where it is at the nearer one than half of what it moves.
  CellPicture motion(const MotionPrimitive& primitive) const {
    double curvature = 0.0;
    for (const Segment& s : primitive.segments) curvature = std::max(curvature, std::abs(s.curvature_1pm));
    const double moved_m = primitive.length_m * (1.0 + curvature * vehicle_.circumscribed_radius_m());
    const int steps = static_cast<int>(std::ceil(moved_m / kFarthestStep_m));
    const double growth_m = kClearance_m + 0.5 * moved_m / steps;
    CellPicture picture(half_);
    for (int k = 0; k <= steps; ++k) {
      picture.add(cells_at(pose_along(primitive, primitive.length_m * k / steps), growth_m));
    }
    return picture;
  }

  double cell_m() const { return frame_.resolution_m; }

 private:
  std::vector<RowSpan> cells_at(const geometry::Pose& pose, double growth_m) const {
    return covered_spans(footprint_at(pose, grown(vehicle_.footprint(), growth_m)), frame_);
  }

  const VehicleModel& vehicle_;
  GridFrame frame_;
  int half_ = 0;
};

double longest(const PrimitiveSet& primitives) {
  double length_m = 0.0;
  for (const MotionPrimitive& p : primitives.all()) length_m = std::max(length_m, p.length_m);
  return length_m;
}

}  // namespace

// Only forward primitives of the first quarter are swept: the others cover the same cells, turned, or seen
// from the other end.
SweptCells::SweptCells(const VehicleModel& vehicle, const PrimitiveSet& primitives, int cells_per_step)
    : cells_per_step_(cells_per_step) {
  assert(cells_per_step > 0);
  const Sweeper sweeper(vehicle, primitives.options().resolution_m / cells_per_step,
                        2.0 * longest(primitives));
  constexpr std::size_t kForward = PrimitiveSet::kPerHeading / 2;
  motions_.resize(primitives.all().size());
  stands_.resize(kHeadings);
  for (int first = 0; first < kQuarter; ++first) {
    const CellPicture standing = sweeper.stand(first);
    for (int quarters = 0; quarters < 4; ++quarters) {
      stands_[static_cast<std::size_t>(first + quarters * kQuarter)] =
          standing.seen_from({0, 0}, quarters).to_motion(sweeper.cell_m());
    }
    for (std::size_t k = 0; k < kForward; ++k) {
      const MotionPrimitive& primitive = primitives.from(first)[k];
      const CellPicture moving = sweeper.motion(primitive);
      const Cell end{primitive.end.x * cells_per_step, primitive.end.y * cells_per_step};
      for (int quarters = 0; quarters < 4; ++quarters) {
        const int start_heading = wrap_heading(first + quarters * kQuarter);
        const int end_heading = wrap_heading(primitive.end_heading + quarters * kQuarter);
        const auto index = [&](int heading, std::size_t kind) {
          return static_cast<std::size_t>(heading) * PrimitiveSet::kPerHeading + kind;
        };
        motions_[index(start_heading, k)] = moving.seen_from({0, 0}, quarters).to_motion(sweeper.cell_m());
        motions_[index(end_heading, kForward + k)] =
            moving.seen_from(end, quarters).to_motion(sweeper.cell_m());
      }
    }
  }
}

bool SweptCells::free_cells(const OccupancyGrid& grid, const SweptMotion& motion, Cell cell) {
  return std::ranges::none_of(motion.spans, [&](const RowSpan& span) {
    return grid.any_blocked(span.row + cell.row, span.first + cell.column, span.last + cell.column);
  });
}

}  // namespace stepwright::fleet
