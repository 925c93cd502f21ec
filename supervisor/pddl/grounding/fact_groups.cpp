#include "supervisor/pddl/grounding/fact_groups.h"

#include <algorithm>
#include <queue>

namespace stepwright::pddl {
namespace {

// By size, then those that always have a value, then the first found.
struct Rank {
  std::size_t size = 0;
  bool exactly_one = false;
  std::size_t set = 0;
  friend bool operator<(const Rank& a, const Rank& b) {
    if (a.size != b.size) return a.size < b.size;
    if (a.exactly_one != b.exactly_one) return b.exactly_one;
    return a.set > b.set;
  }
};

}  // namespace

std::vector<FactGroup> choose_groups(std::vector<FactGroup> sets, std::size_t facts) {
  std::vector<bool> covered(facts, false);
  std::vector<FactGroup> groups;
  std::priority_queue<Rank> order;
  const auto enqueue = [&](std::size_t s) {
    if (sets[s].facts.size() > 1) order.push({sets[s].facts.size(), sets[s].exactly_one, s});
  };
  for (std::size_t s = 0; s < sets.size(); ++s) enqueue(s);
  while (!order.empty()) {
    const std::size_t s = order.top().set;
    order.pop();
    FactGroup& set = sets[s];
    const std::size_t before = set.facts.size();
    std::erase_if(set.facts, [&](int fact) { return covered[static_cast<std::size_t>(fact)]; });
    if (set.facts.size() == before) {
      for (const int fact : set.facts) covered[static_cast<std::size_t>(fact)] = true;
      groups.push_back(std::move(set));
    } else {
      set.exactly_one = false;
      enqueue(s);
    }
  }
  for (std::size_t fact = 0; fact < facts; ++fact) {
    if (!covered[fact]) groups.push_back({{static_cast<int>(fact)}, false});
  }
  std::sort(groups.begin(), groups.end(),
            [](const FactGroup& a, const FactGroup& b) { return a.facts.front() < b.facts.front(); });
  return groups;
}

}  // namespace stepwright::pddl
