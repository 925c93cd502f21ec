#pragma once

// The open list of Dijkstra's algorithm for whole costs (Dial 1969): one bucket for each cost within the
// length of the longest edge, used in a circle. Not for several threads.
//
//   buckets.push(cost, state);
//   while (const auto next = buckets.pop()) ...  // costs never fall

#include <cassert>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace stepwright::fleet::internal {

class CostBuckets {
 public:
  explicit CostBuckets(std::uint32_t longest_edge) : buckets_(std::size_t{longest_edge} + 1) {}

  // Requires cost within the longest edge above what was popped last.
  void push(std::uint32_t cost, std::uint32_t state) {
    assert(cost >= cost_ && cost - cost_ < buckets_.size());
    buckets_[cost % buckets_.size()].push_back(state);
    ++size_;
  }

  // The cheapest (cost, state); nothing if there is none.
  std::optional<std::pair<std::uint32_t, std::uint32_t>> pop() {
    if (size_ == 0) return std::nullopt;
    while (buckets_[cost_ % buckets_.size()].empty()) ++cost_;
    auto& bucket = buckets_[cost_ % buckets_.size()];
    const std::uint32_t state = bucket.back();
    bucket.pop_back();
    --size_;
    return std::pair{cost_, state};
  }

 private:
  std::vector<std::vector<std::uint32_t>> buckets_;
  std::uint32_t cost_ = 0;
  std::size_t size_ = 0;
};

}  // namespace stepwright::fleet::internal
