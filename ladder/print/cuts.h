#pragma once

// Cuts of a row of things into pieces that fit a page. Internal to this folder; pure functions.

#include <optional>
#include <vector>

namespace stepwright::print {

struct Interval {
  int begin = 0;
  int end = 0;
};

// The middles between intervals, in order; the last one is `length`.
std::vector<int> gaps(std::vector<Interval> intervals, int length);

// Positions from 0 to `length` such that neighbours are `most` apart at most and none lies inside an
// interval, as few as possible; nullopt if there are none.
std::optional<std::vector<int>> cuts(std::vector<Interval> intervals, int length, int most);

}  // namespace stepwright::print
