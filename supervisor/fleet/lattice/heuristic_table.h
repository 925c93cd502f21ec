#pragma once

// Least costs from one pose to another near one where nothing stands in the way: the heuristic look-up table
// of Knepper and Kelly 2006.
//
// A value that does not change; any thread may read. Worked out by Dijkstra's algorithm backwards from each
// of four headings; the other twelve look the same turned by right angles. An entry is the exact least cost
// on the free lattice, or a lower bound of it where the way would lead far out of the table's range.
//
//   const auto loaded = HeuristicTable::load_or_build(primitives, {}, "cache/forklift.table");
//   loaded.table.cost_mm({-12, 3}, 4, 0);  // from 2.4 m behind and 0.6 m left, heading 4, to heading 0

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/fleet/lattice/primitive_set.h"

namespace stepwright::fleet {

struct TableOptions {
  double range_m = 10.0;  // in x and in y
  double margin_m = 8.0;  // how far beyond it ways are searched
  unsigned threads = 1;   // 1 to 4 are of use
  // Building ends soon after this has become true. Not owned; may be null.
  const std::atomic<bool>* cancel = nullptr;
};

class HeuristicTable {
 public:
  static constexpr std::uint32_t kMostCost_mm = 65535;

  struct Loaded;

  // Where it was cancelled all entries are 0, which is a lower bound, too.
  static HeuristicTable build(const PrimitiveSet& primitives, const TableOptions& options = {});
  // From the file if it belongs to these primitives and range and is whole; else built, and written there.
  // That it cannot be written is no failure, `note` says so. What was cancelled is not written.
  static Loaded load_or_build(const PrimitiveSet& primitives, const TableOptions& options,
                              const std::filesystem::path& file);

  // F0401: the file cannot be read or is no table; F0402: it belongs to other primitives or another range;
  // F0403: damaged.
  [[nodiscard]] static result::Result<HeuristicTable> read(const PrimitiveSet& primitives,
                                                           const TableOptions& options,
                                                           const std::filesystem::path& file);
  // F0404. The file is there with all of its content or not at all.
  // `options` are those of the build.
  [[nodiscard]] result::Result<void> write(const PrimitiveSet& primitives, const TableOptions& options,
                                           const std::filesystem::path& file) const;

  std::int32_t range() const { return range_; }
  // From a pose at `offset` relative to the goal's vertex. Zero where the offset is out of range.
  std::uint32_t cost_mm(GridVector offset, int heading, int goal_heading) const {
    const int quarters = (4 - goal_heading / kQuarter) % 4;
    const GridVector at = turned(offset, quarters);
    if (at.x < -range_ || at.x > range_ || at.y < -range_ || at.y > range_) return 0;
    return costs_[index(goal_heading % kQuarter, at, wrap_heading(heading + quarters * kQuarter))];
  }

  friend bool operator==(const HeuristicTable&, const HeuristicTable&) = default;

 private:
  explicit HeuristicTable(std::int32_t range);
  static std::int32_t range_in_vertices(const PrimitiveSet& primitives, const TableOptions& options);

  std::size_t index(int goal_heading, GridVector at, int heading) const {
    const auto side = static_cast<std::size_t>(2 * range_ + 1);
    return ((static_cast<std::size_t>(goal_heading) * side + static_cast<std::size_t>(at.y + range_)) * side +
            static_cast<std::size_t>(at.x + range_)) *
               kHeadings +
           static_cast<std::size_t>(heading);
  }

  std::int32_t range_ = 0;            // in vertices
  std::vector<std::uint16_t> costs_;  // goal heading, y, x, heading
};

struct HeuristicTable::Loaded {
  HeuristicTable table;
  bool built = false;
  std::string note;        // why it was built, or why it was not written
  bool unwritten = false;  // it could not be written
};

}  // namespace stepwright::fleet
