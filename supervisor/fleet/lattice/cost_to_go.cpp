#include "supervisor/fleet/lattice/cost_to_go.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace stepwright::fleet {

namespace {

constexpr std::uint32_t kUnreached = std::numeric_limits<std::uint32_t>::max();

struct Entry {
  std::uint32_t cost_mm = 0;
  std::uint32_t pose = 0;
  GridVector vertex;
  int heading = 0;
};

// Where a primitive that ends with a heading comes from.
struct Arrival {
  GridVector end;
  int heading = 0;   // at its start
  unsigned bit = 0;  // among those of that heading
  std::uint32_t cost_mm = 0;
};

std::vector<std::vector<Arrival>> arrivals_of(const PrimitiveSet& primitives) {
  std::vector<std::vector<Arrival>> arrivals(kHeadings);
  for (int heading = 0; heading < kHeadings; ++heading) {
    for (unsigned k = 0; k < PrimitiveSet::kPerHeading; ++k) {
      const MotionPrimitive& primitive = primitives.from(heading)[k];
      arrivals[static_cast<std::size_t>(primitive.end_heading)].push_back(
          {primitive.end, heading, k, primitive.cost_mm});
    }
  }
  return arrivals;
}

// The open list: buckets no wider than the cheapest primitive is long, so that within one of them nothing can
// become cheaper and the order does not matter; used in a circle.
class OpenList {
 public:
  explicit OpenList(const PrimitiveSet& primitives) {
    std::uint32_t cheapest = kUnreached, dearest = 0;
    for (const MotionPrimitive& primitive : primitives.all()) {
      cheapest = std::min(cheapest, primitive.cost_mm);
      dearest = std::max(dearest, primitive.cost_mm);
    }
    shift_ = std::bit_width(cheapest) - 1;
    buckets_.resize((dearest >> shift_) + 2);
  }

  void push(const Entry& entry) {
    buckets_[(entry.cost_mm >> shift_) % buckets_.size()].push_back(entry);
    ++size_;
  }
  bool empty() const { return size_ == 0; }
  Entry pop() {
    while (buckets_[at_ % buckets_.size()].empty()) ++at_;
    auto& bucket = buckets_[at_ % buckets_.size()];
    const Entry entry = bucket.back();
    bucket.pop_back();
    --size_;
    return entry;
  }

 private:
  int shift_ = 0;
  std::vector<std::vector<Entry>> buckets_;
  std::size_t at_ = 0;
  std::size_t size_ = 0;
};

}  // namespace

CostToGo::CostToGo(const FreeMotions& motions, const PrimitiveSet& primitives, GridVector goal, int heading)
    : motions_(&motions), costs_(motions.poses(), kNever) {
  const auto last = motions.number(goal, heading);
  if (!last) return;
  const auto arrivals = arrivals_of(primitives);
  std::vector<std::uint32_t> cost_mm(motions.poses(), kUnreached);
  OpenList open(primitives);
  cost_mm[*last] = 0;
  open.push({0, *last, goal, heading});
  while (!open.empty()) {
    const Entry here = open.pop();
    if (cost_mm[here.pose] != here.cost_mm) continue;
    for (const Arrival& arrival : arrivals[static_cast<std::size_t>(here.heading)]) {
      const GridVector from = here.vertex - arrival.end;
      const auto pose = motions.number(from, arrival.heading);
      if (!pose || (motions.from(*pose) >> arrival.bit & 1U) == 0) continue;
      const std::uint32_t cost = here.cost_mm + arrival.cost_mm;
      if (cost >= cost_mm[*pose]) continue;
      cost_mm[*pose] = cost;
      open.push({cost, *pose, from, arrival.heading});
    }
  }
  for (std::size_t pose = 0; pose < cost_mm.size(); ++pose) {
    if (cost_mm[pose] == kUnreached) continue;
    costs_[pose] = static_cast<std::uint16_t>(std::min<std::uint32_t>(cost_mm[pose] / kUnit_mm, kNever - 1));
  }
}

}  // namespace stepwright::fleet
