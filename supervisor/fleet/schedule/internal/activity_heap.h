#pragma once

// Sections by how much they had to do with recent conflicts (VSIDS: Moskewicz et al. 2001), the most active
// on top. Only sections that ever met a conflict are in it. One thread.

#include <cstdint>
#include <utility>
#include <vector>

namespace stepwright::fleet::internal {

class ActivityHeap {
 public:
  explicit ActivityHeap(std::size_t sections) : activity_(sections, 0.0), place_(sections, kNowhere) {}

  bool empty() const { return heap_.empty(); }
  bool active(std::uint32_t section) const { return activity_[section] > 0.0; }

  void bump(std::uint32_t section) {
    activity_[section] += step_;
    if (activity_[section] > 1e100) rescale();
    if (place_[section] != kNowhere) {
      rise(place_[section]);
    } else {
      insert(section);
    }
  }
  // Earlier increments count less from here on.
  void decay() { step_ /= 0.95; }

  void insert(std::uint32_t section) {
    if (place_[section] != kNowhere) return;
    heap_.push_back(section);
    place_[section] = static_cast<std::uint32_t>(heap_.size() - 1);
    rise(heap_.size() - 1);
  }

  std::uint32_t pop() {
    const std::uint32_t top = heap_.front();
    place_[top] = kNowhere;
    const std::uint32_t last = heap_.back();
    heap_.pop_back();
    if (!heap_.empty()) {
      put(0, last);
      sink(0);
    }
    return top;
  }

 private:
  static constexpr std::uint32_t kNowhere = 0xFFFFFFFF;

  void put(std::size_t place, std::uint32_t section) {
    heap_[place] = section;
    place_[section] = static_cast<std::uint32_t>(place);
  }
  void rise(std::size_t place) {
    const std::uint32_t section = heap_[place];
    while (place > 0 && activity_[heap_[(place - 1) / 2]] < activity_[section]) {
      put(place, heap_[(place - 1) / 2]);
      place = (place - 1) / 2;
    }
    put(place, section);
  }
  void sink(std::size_t place) {
    const std::uint32_t section = heap_[place];
    while (2 * place + 1 < heap_.size()) {
      std::size_t child = 2 * place + 1;
      if (child + 1 < heap_.size() && activity_[heap_[child]] < activity_[heap_[child + 1]]) ++child;
      if (activity_[heap_[child]] <= activity_[section]) break;
      put(place, heap_[child]);
      place = child;
    }
    put(place, section);
  }
  void rescale() {
    for (double& activity : activity_) activity *= 1e-100;
    step_ *= 1e-100;
  }

  std::vector<double> activity_;
  std::vector<std::uint32_t> place_;
  std::vector<std::uint32_t> heap_;
  double step_ = 1.0;
};

}  // namespace stepwright::fleet::internal
