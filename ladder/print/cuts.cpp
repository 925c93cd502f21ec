#include "ladder/print/cuts.h"

#include <algorithm>
#include <utility>

namespace stepwright::print {

std::vector<int> gaps(std::vector<Interval> intervals, int length) {
  std::sort(intervals.begin(), intervals.end(), [](Interval a, Interval b) { return a.begin < b.begin; });
  std::vector<int> result;
  int end = 0;
  for (const Interval& each : intervals) {
    if (each.begin > end && end > 0) result.push_back((end + each.begin) / 2);
    end = std::max(end, each.end);
  }
  result.push_back(length);
  return result;
}

std::optional<std::vector<int>> cuts(std::vector<Interval> intervals, int length, int most) {
  const std::vector<int> possible = gaps(std::move(intervals), length);
  std::vector<int> result{0};
  for (std::size_t i = 0; i < possible.size(); ++i) {
    if (possible[i] - result.back() > most) return std::nullopt;
    if (i + 1 < possible.size() && possible[i + 1] - result.back() <= most) continue;
    result.push_back(possible[i]);
  }
  return result;
}

}  // namespace stepwright::print
