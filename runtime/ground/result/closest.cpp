#include "runtime/ground/result/closest.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace stepwright::result {
namespace {

// More than `most` if the words are further apart than that.
std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t most) {
  if (std::max(a.size(), b.size()) - std::min(a.size(), b.size()) > most) return most + 1;
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({row[j - 1] + 1, last[j] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    // Swapping looks two rows back, so both must be beyond the limit.
    if (std::min(*std::min_element(row.begin(), row.end()), *std::min_element(last.begin(), last.end())) >
        most)
      return most + 1;
    std::swap(before, last);
    std::swap(last, row);
  }
  return last.back();
}

}  // namespace

const std::string* closest(std::string_view word, std::span<const std::string> candidates,
                           std::size_t most_edits) {
  const std::string* best = nullptr;
  std::size_t fewest = most_edits + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t edits = edit_distance(word, candidate, fewest - 1);
    if (edits >= fewest) continue;
    fewest = edits;
    best = &candidate;
    if (fewest == 0) break;
  }
  return best;
}

}  // namespace stepwright::result
