#pragma once

// Options and answers of a path planner. Values; any thread may read.
//
//   const PathOptions soon{.first_weight = 3.0, .last_weight = 1.5};
//   if (answer.end == PathEnd::Found) follow(answer.path->poses);  // costs at most 1.5 times the least

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/ground/result/diagnostic.h"
#include "supervisor/fleet/lattice/motion_primitive.h"

namespace stepwright::fleet {

// Estimate of the remaining cost. All are admissible, so that A* finds the least cost with each.
enum class Heuristic : std::uint8_t {
  Euclid,    // the straight line
  Table,     // the greater of it and the look-up table
  Combined,  // the greatest of these and the distance around obstacles
};

struct PathOptions {
  // ARA* (Likhachev, Gordon, Thrun 2003): the estimate is multiplied by `first_weight`, then by less and
  // less. 1.0 from the start: A*.
  double first_weight = 1.0;  // 1 to 100
  double weight_step = 0.5;   // at least 0.01
  double last_weight =
      1.0;  // at least 1: search ends once the path is proved to cost at most so many times more
  Heuristic heuristic = Heuristic::Combined;
  double sample_m = kPathSample_m;  // between poses of the answer, at most
  std::optional<std::chrono::steady_clock::time_point> deadline{};
  // The search ends as at the deadline after about so many expansions, on every machine alike. 0: no limit.
  std::uint64_t most_expanded = 0;
  // The search ends soon after this has become true: it is looked at every few hundred expansions, and while
  // distances around obstacles are worked out. Not owned; may be null.
  const std::atomic<bool>* cancel = nullptr;
};

// Where a primitive of the path begins.
struct PathMark {
  std::size_t pose = 0;       // index into LatticePath::poses
  std::size_t primitive = 0;  // index into PrimitiveSet::all
};

struct LatticePath {
  geometry::Path poses;         // from start to goal, at least one
  std::vector<PathMark> marks;  // in order; empty if the start is the goal
  double length_m = 0.0;
  std::uint32_t cost_mm = 0;
};

// A path as it was found, and what was proved of it then.
struct Improvement {
  double weight = 1.0;
  std::uint32_t cost_mm = 0;
  double epsilon = 1.0;  // no path costs less than cost_mm / epsilon
  std::uint64_t expanded = 0;
  std::chrono::duration<double, std::milli> after{0.0};
};

enum class PathEnd : std::uint8_t {
  Found,        // the last round came to its end; Improvement::epsilon says how good the path is
  Refused,      // start or goal is in collision or off the map
  Unreachable,  // proved: no path on the lattice
  Deadline,     // time ended first; `path` holds the best one, if any
  Cancelled,    // the same
};

struct PathAnswer {
  PathEnd end = PathEnd::Unreachable;
  std::optional<LatticePath> path;
  double epsilon = 0.0;  // no path costs less than path->cost_mm / epsilon; 0 without a path
  std::vector<Improvement> improvements;
  result::Diagnostics diagnostics;  // why there is no path
  std::uint64_t expanded = 0;
  std::size_t peak_bytes = 0;  // of the search, without the map
};

}  // namespace stepwright::fleet
