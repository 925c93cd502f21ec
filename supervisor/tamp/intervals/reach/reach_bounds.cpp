#include "supervisor/tamp/intervals/reach/reach_bounds.h"

#include <algorithm>
#include <map>

namespace stepwright::tamp {
namespace {

constexpr std::int32_t kParts = 4;        // of a coarse cell along each axis
constexpr std::size_t kManyCells = 4096;  // of which coarse ones are made

}  // namespace

std::span<const Arc> ReachBounds::arcs_at(const Point3& at) const {
  const ReachGrid& rows = grid();
  Point3 row{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    row[axis] = rows.row(axis, at[axis]);
    if (!rows.has(axis, row[axis])) return {};
  }
  return arcs(rows.index(row[0], row[1], row[2]));
}

ArcSet ReachBounds::arcs_over(const Box& box) const {
  const ReachGrid& rows = grid();
  Point3 first{}, last{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    first[axis] = std::max<std::int64_t>(rows.row(axis, box[axis].low_nm), 0);
    last[axis] = std::min<std::int64_t>(rows.row(axis, box[axis].high_nm), rows.cells[axis] - 1);
  }
  ArcSet all;
  for (std::int64_t z = first[2]; z <= last[2]; ++z)
    for (std::int64_t y = first[1]; y <= last[1]; ++y)
      for (std::int64_t x = first[0]; x <= last[0] && !all.is_full(); ++x) all.add(arcs(rows.index(x, y, z)));
  return all;
}

ReachTable ReachTable::fill(const ReachGrid& grid, const std::function<ArcSet(const Box&)>& bounds) {
  ReachTable table;
  table.grid_ = grid;
  table.rows_.reserve(grid.size());
  std::map<std::vector<std::uint64_t>, std::uint32_t> known;
  std::vector<std::uint64_t> key;
  for (std::int64_t z = 0; z < grid.cells[2]; ++z) {
    for (std::int64_t y = 0; y < grid.cells[1]; ++y) {
      for (std::int64_t x = 0; x < grid.cells[0]; ++x) {
        const ArcSet set = bounds({grid.span(0, x), grid.span(1, y), grid.span(2, z)});
        key.clear();
        for (const Arc arc : set.arcs()) key.push_back(std::uint64_t{arc.low} << 32 | arc.width);
        const auto [entry, is_new] =
            known.try_emplace(key, static_cast<std::uint32_t>(table.entries_.size()));
        if (is_new) {
          table.entries_.push_back(
              {static_cast<std::uint32_t>(table.pool_.size()), static_cast<std::uint32_t>(set.size())});
          table.pool_.insert(table.pool_.end(), set.arcs().begin(), set.arcs().end());
        }
        table.rows_.push_back(entry->second);
      }
    }
  }
  if (grid.size() > kManyCells) {
    ReachGrid coarse = grid;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      coarse.step_nm[axis] *= kParts;
      coarse.cells[axis] = (grid.cells[axis] + kParts - 1) / kParts;
    }
    table.coarse_ = std::make_shared<const ReachTable>(
        fill(coarse, [&](const Box& cell) { return table.arcs_over(cell); }));
  }
  return table;
}

}  // namespace stepwright::tamp
