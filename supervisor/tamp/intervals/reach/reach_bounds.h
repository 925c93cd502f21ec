#pragma once

// The reach of an arm: for each cell of a grid over the positions of its tool, a set of arcs outside of which
// no angle of the tool about the vertical can be reached from anywhere in the cell: sound outer bounds.
// Whoever finds no angle has a proof; whoever finds one has not reached it yet. (The maps m_gamma and M_gamma
// of F. Lagriffoul, L. Karlsson, A. Saffiotti 2012, which have one interval for each node of a grid.)
//
// Positions are whole nanometres, so that every position is in one cell and sums of lengths are exact.
// Whoever fills a cell looks at it a nanometre wider on all sides. Outside of the grid nothing can be
// reached.
//
// Immutable; any thread may read.
//
//   const ReachTable right = ReachTable::fill(grid, [&](const Box& cell) { return arcs_of(cell); });
//   right.arcs_at({600'000'000, 250'000'000, 440'000'000});      // of the tool at this point

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "supervisor/tamp/intervals/reach/arc_set.h"

namespace stepwright::tamp {

// Requires a number below 9e9 m.
inline std::int64_t nanometres_of(double m) {
  return static_cast<std::int64_t>(std::llround(m * 1e9));
}
inline double metres_of(std::int64_t nm) {
  return static_cast<double>(nm) * 1e-9;
}

struct Span {
  std::int64_t low_nm = 0, high_nm = 0;  // both included

  bool empty() const { return low_nm > high_nm; }
  bool contains(std::int64_t nm) const { return low_nm <= nm && nm <= high_nm; }
  std::int64_t width_nm() const { return high_nm - low_nm; }
  std::int64_t middle_nm() const { return low_nm + (high_nm - low_nm) / 2; }
  friend bool operator==(Span, Span) = default;
};
inline Span intersection_of(Span a, Span b) {
  return {std::max(a.low_nm, b.low_nm), std::min(a.high_nm, b.high_nm)};
}

using Point3 = std::array<std::int64_t, 3>;  // x, y, z in nanometres
using Box = std::array<Span, 3>;

struct ReachGrid {
  Point3 origin_nm{};  // the lowest corner
  Point3 step_nm{};    // above 0
  std::array<std::int32_t, 3> cells{};

  std::size_t size() const {
    return static_cast<std::size_t>(cells[0]) * static_cast<std::size_t>(cells[1]) *
           static_cast<std::size_t>(cells[2]);
  }
  // Which row of cells along an axis; below 0 or from `cells` on outside of the grid.
  std::int64_t row(std::size_t axis, std::int64_t nm) const {
    const std::int64_t off = nm - origin_nm[axis], step = step_nm[axis];
    return off >= 0 ? off / step : -((step - 1 - off) / step);
  }
  Span span(std::size_t axis, std::int64_t row) const {
    const std::int64_t low = origin_nm[axis] + row * step_nm[axis];
    return {low, low + step_nm[axis] - 1};
  }
  Span extent(std::size_t axis) const {
    return {origin_nm[axis], origin_nm[axis] + cells[axis] * step_nm[axis] - 1};
  }
  bool has(std::size_t axis, std::int64_t row) const { return row >= 0 && row < cells[axis]; }
  // x changes first. Requires rows of the grid.
  std::size_t index(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return static_cast<std::size_t>((z * cells[1] + y) * cells[0] + x);
  }
  friend bool operator==(const ReachGrid&, const ReachGrid&) = default;
};

// Where distances of an arm are measured from, and to.
struct Shoulder {
  std::array<double, 3> at_m{};
  double wrist_above_m = 0.0;  // the wrist above the tool
};

class ReachBounds {
 public:
  virtual ~ReachBounds() = default;
  virtual const ReachGrid& grid() const = 0;
  virtual std::span<const Arc> arcs(std::size_t cell) const = 0;
  // The same reach in larger cells, each with what its parts have; none where there is nothing to gain.
  virtual const ReachBounds* coarse() const { return nullptr; }

  std::span<const Arc> arcs_at(const Point3& at) const;
  // Of all cells that the box touches.
  ArcSet arcs_over(const Box& box) const;
};

class ReachTable final : public ReachBounds {
 public:
  // Asks for each cell in turn. Requires steps above 0 and fewer than 2^31 cells.
  static ReachTable fill(const ReachGrid& grid, const std::function<ArcSet(const Box& cell)>& bounds);

  const ReachGrid& grid() const override { return grid_; }
  std::span<const Arc> arcs(std::size_t cell) const override {
    const Entry entry = entries_[rows_[cell]];
    return {pool_.data() + entry.first, entry.count};
  }
  const ReachBounds* coarse() const override { return coarse_.get(); }
  std::size_t different() const { return entries_.size(); }  // sets of arcs, each stored once

 private:
  struct Entry {
    std::uint32_t first = 0, count = 0;
  };
  ReachGrid grid_;
  std::vector<std::uint32_t> rows_;  // of each cell: its entry
  std::vector<Entry> entries_;
  std::vector<Arc> pool_;
  std::shared_ptr<const ReachTable> coarse_;  // shared by copies: it never changes
};

}  // namespace stepwright::tamp
