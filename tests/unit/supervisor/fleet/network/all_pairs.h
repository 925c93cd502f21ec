#pragma once

// The oracle of the network's tests: all distances between all timepoints by Floyd and Warshall's algorithm.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "supervisor/fleet/network/constraint.h"

namespace stepwright::fleet {

class AllPairs {
 public:
  // The horizon and time zero are constraints, too.
  AllPairs(std::size_t timepoints, std::span<const Constraint> constraints);

  bool consistent() const;
  std::int64_t earliest_ms(std::size_t t) const { return at(0, t); }
  std::int64_t latest_ms(std::size_t t) const { return -at(t, 0); }

 private:
  std::int64_t at(std::size_t from, std::size_t to) const { return longest_[from * size_ + to]; }

  std::size_t size_;
  std::vector<std::int64_t> longest_;
};

// Earliest times by the rounds of Bellman and Ford; nothing if the constraints contradict each other.
std::optional<std::vector<std::int64_t>> earliest_by_rounds(std::size_t timepoints,
                                                            std::span<const Constraint> constraints);

}  // namespace stepwright::fleet
