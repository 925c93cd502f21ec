#include "tests/unit/supervisor/fleet/network/all_pairs.h"

#include <algorithm>

namespace stepwright::fleet {

namespace {
constexpr std::int64_t kUnknown = -1'000'000'000'000;
}

AllPairs::AllPairs(std::size_t timepoints, std::span<const Constraint> constraints)
    : size_(timepoints), longest_(timepoints * timepoints, kUnknown) {
  const auto raise = [&](std::size_t from, std::size_t to, std::int64_t least) {
    std::int64_t& cell = longest_[from * size_ + to];
    cell = std::max(cell, least);
  };
  for (std::size_t t = 0; t < size_; ++t) {
    raise(0, t, 0);
    raise(t, 0, -static_cast<std::int64_t>(kHorizon_ms));
    raise(t, t, 0);
  }
  for (const Constraint& c : constraints) raise(c.from.value, c.to.value, c.least_ms);
  for (std::size_t middle = 0; middle < size_; ++middle) {
    for (std::size_t from = 0; from < size_; ++from) {
      for (std::size_t to = 0; to < size_; ++to) raise(from, to, at(from, middle) + at(middle, to));
    }
    // Distances would double in every round on a cycle that grows.
    if (!consistent()) return;
  }
}

bool AllPairs::consistent() const {
  for (std::size_t t = 0; t < size_; ++t) {
    if (at(t, t) > 0) return false;
  }
  return true;
}

std::optional<std::vector<std::int64_t>> earliest_by_rounds(std::size_t timepoints,
                                                            std::span<const Constraint> constraints) {
  std::vector<std::int64_t> times(timepoints, 0);
  for (std::size_t round = 0; round <= timepoints; ++round) {
    bool changed = false;
    for (const Constraint& c : constraints) {
      const std::int64_t time = times[c.from.value] + c.least_ms;
      if (time <= times[c.to.value]) continue;
      times[c.to.value] = time;
      changed = true;
    }
    const auto inside = [](std::int64_t time) { return time <= kHorizon_ms; };
    if (times[0] > 0 || !std::ranges::all_of(times, inside)) return std::nullopt;
    if (!changed) return times;
  }
  return std::nullopt;
}

}  // namespace stepwright::fleet
