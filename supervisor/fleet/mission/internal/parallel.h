#pragma once

// The same work for many indices on a few threads, in no particular order.
//
//   each_index(legs.size(), 2, [&](std::size_t k) { answers[k] = plan(legs[k]); });

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace stepwright::fleet::internal {

// Returns when all is done. `work` must not throw.
template <typename Work>
void each_index(std::size_t count, unsigned threads, const Work& work) {
  std::atomic<std::size_t> next = 0;
  const auto take = [&] {
    for (std::size_t k = next++; k < count; k = next++) work(k);
  };
  std::vector<std::jthread> helpers;
  const std::size_t wanted = std::min<std::size_t>(threads, count);
  for (std::size_t k = 1; k < wanted; ++k) helpers.emplace_back(take);
  take();
}

}  // namespace stepwright::fleet::internal
