#pragma once

// A queue over small whole keys: one stack per key, the least key first. Keys beyond the last bucket share
// it.
//
// Thread rule: one owner; it keeps its memory between uses.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace stepwright::pddl {

template <typename T>
class BucketQueue {
 public:
  void push(int key, const T& item) {
    const auto bucket = static_cast<std::size_t>(std::min(key, kMostBuckets - 1));
    if (bucket >= buckets_.size()) buckets_.resize(bucket + 1);
    buckets_[bucket].push_back(item);
    least_ = std::min(least_, bucket);
    ++size_;
  }

  bool empty() const { return size_ == 0; }

  // Requires that it is not empty.
  T pop() {
    while (buckets_[least_].empty()) ++least_;
    const T item = buckets_[least_].back();
    buckets_[least_].pop_back();
    --size_;
    return item;
  }

  void clear() {
    if (size_ > 0) {
      for (std::size_t b = least_; b < buckets_.size(); ++b) buckets_[b].clear();
    }
    size_ = 0;
    least_ = 0;
  }

 private:
  static constexpr int kMostBuckets = 1 << 16;
  std::vector<std::vector<T>> buckets_;
  std::size_t least_ = 0;
  std::size_t size_ = 0;
};

}  // namespace stepwright::pddl
