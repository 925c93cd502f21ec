#include "supervisor/fleet/lattice/swept_cells.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>
#include <span>

namespace stepwright::fleet {

namespace {

constexpr double kFarthestStep_m = 0.02;  // no point of the outline moves further between two samples

constexpr double kRounding_m = 1e-4;  // of distances in single precision

// From a corner of the grid to the farthest corner of a cell of the spans.
float covering_radius(std::span<const RowSpan> spans, Cell middle, double cell_m) {
  int farthest = 0;  // squared, in cells
  for (const RowSpan& span : spans) {
    const int x = std::max(span.last + 1 - middle.column, middle.column - span.first);
    const int y = std::max(span.row + 1 - middle.row, middle.row - span.row);
    farthest = std::max(farthest, x * x + y * y);
  }
  return static_cast<float>(cell_m * std::sqrt(farthest) + kRounding_m);
}

// Cuts the cells into slices across the longer side of their bounds and lays a disc around each slice.
void cover(SweptMotion& motion, double cell_m) {
  Cell low{motion.spans.front().first, motion.spans.front().row};
  Cell high{motion.spans.front().last, motion.spans.back().row};
  for (const RowSpan& span : motion.spans) {
    low.column = std::min(low.column, span.first);
    high.column = std::max(high.column, span.last);
  }
  const bool by_column = high.column - low.column > high.row - low.row;
  const int first = by_column ? low.column : low.row;
  const int extent = (by_column ? high.column : high.row) - first + 1;
  const auto slices = static_cast<int>(motion.discs.size());
  for (int slice = 0; slice < slices; ++slice) {
    const int from = first + extent * slice / slices;
    const int to = first + extent * (slice + 1) / slices - 1;
    std::vector<RowSpan> part;
    for (const RowSpan& span : motion.spans) {
      const RowSpan cut =
          by_column ? RowSpan{span.row, std::max(span.first, from), std::min(span.last, to)} : span;
      const bool within = by_column ? cut.first <= cut.last : from <= span.row && span.row <= to;
      if (within) part.push_back(cut);
    }
    if (part.empty()) continue;  // a disc of radius zero at the vertex
    Cell part_low{part.front().first, part.front().row};
    Cell part_high{part.front().last, part.back().row};
    for (const RowSpan& span : part) {
      part_low.column = std::min(part_low.column, span.first);
      part_high.column = std::max(part_high.column, span.last);
    }
    const Cell middle{(part_low.column + part_high.column + 1) / 2, (part_low.row + part_high.row + 1) / 2};
    motion.discs[static_cast<std::size_t>(slice)] = {middle, covering_radius(part, middle, cell_m)};
  }
}

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
    for (int row = -half_; row < half_; ++row) {
      for (int column = -half_; column < half_; ++column) {
        if (!at({column, row})) continue;
        auto& spans = motion.spans;
        if (!spans.empty() && spans.back().row == row && spans.back().last == column - 1) {
          spans.back().last = column;
        } else {
          spans.push_back({row, column, column});
        }
      }
    }
    motion.reach_m = covering_radius(motion.spans, {0, 0}, cell_m);
    cover(motion, cell_m);
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
      : vehicle_(vehicle),
        clearance_m_(SweptCells::clearance_m(vehicle)),
        frame_{.resolution_m = cell_m, .origin = {}, .columns = 1, .rows = 1} {
    half_ = static_cast<int>(
                std::ceil((vehicle.circumscribed_radius_m() + longest_m + clearance_m_ + 0.1) / cell_m)) +
            1;
  }

  CellPicture stand(int heading) const {
    CellPicture picture(half_);
    picture.add(cells_at({0.0, 0.0, heading_rad(heading)}, clearance_m_));
    return picture;
  }

  // Between two samples no point is farther from where it is at the nearer one than half of what it moves.
  CellPicture motion(const MotionPrimitive& primitive) const {
    double curvature = 0.0;
    for (const Segment& s : primitive.segments) curvature = std::max(curvature, std::abs(s.curvature_1pm));
    const double moved_m = primitive.length_m * (1.0 + curvature * vehicle_.circumscribed_radius_m());
    const int steps = static_cast<int>(std::ceil(moved_m / kFarthestStep_m));
    const double growth_m = clearance_m_ + 0.5 * moved_m / steps;
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
  double clearance_m_;
  GridFrame frame_;
  int half_ = 0;
};

double longest(const PrimitiveSet& primitives) {
  double length_m = 0.0;
  for (const MotionPrimitive& p : primitives.all()) length_m = std::max(length_m, p.length_m);
  return length_m;
}

}  // namespace

// The convex hull of an outline and the same turned by a small angle and moved reaches beyond what lies
// between by a quarter of the diagonal times the angle at most.
double SweptCells::clearance_m(const VehicleModel& vehicle) {
  const double diagonal_m = std::hypot(vehicle.front_m + vehicle.rear_m, vehicle.width_m);
  return 0.005 + 0.25 * diagonal_m * kPathSample_m * vehicle.largest_curvature_1pm();
}

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

bool SweptCells::discs_free(const OccupancyGrid& grid, const DistanceField& clearance,
                            const SweptMotion& motion, Cell cell) {
  return std::ranges::all_of(motion.discs, [&](const CoverDisc& disc) {
    const Cell at{cell.column + disc.middle.column, cell.row + disc.middle.row};
    const bool on_map =
        at.column >= 0 && at.column <= grid.frame().columns && at.row >= 0 && at.row <= grid.frame().rows;
    return on_map && clearance.at_corner(at) > disc.radius_m;
  });
}

bool SweptCells::cells_free(const OccupancyGrid& grid, const SweptMotion& motion, Cell cell) {
  return std::ranges::none_of(motion.spans, [&](const RowSpan& span) {
    return grid.any_blocked(span.row + cell.row, span.first + cell.column, span.last + cell.column);
  });
}

}  // namespace stepwright::fleet
