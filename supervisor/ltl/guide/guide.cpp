#include "supervisor/ltl/guide/guide.h"

#include <algorithm>
#include <queue>
#include <utility>

namespace stepwright::ltl {

using geometry::Point;

Guide::Guide(const RegionMap& map, const Automaton& automaton) : map_(map), automaton_(automaton) {
  number_labels();
  find_ways();
}

double Guide::side_m(std::uint32_t region, std::size_t k) const {
  const Point middle = 0.5 * (map_.corner(region, k) + map_.corner(region, k + 1));
  const std::uint32_t other = map_.region(region).across[k];
  return geometry::distance(map_.centroid(region), middle) + geometry::distance(middle, map_.centroid(other));
}

std::uint32_t Guide::after(std::uint32_t state, std::uint32_t from, std::uint32_t to) const {
  return label_of_[from] == label_of_[to] ? state : after(state, to);
}

void Guide::number_labels() {
  for (const Region& region : map_.regions()) {
    const auto known = std::ranges::find(labels_, region.label);
    label_of_.push_back(static_cast<std::size_t>(known - labels_.begin()));
    if (known == labels_.end()) labels_.push_back(region.label);
  }
  const std::size_t states = automaton_.size();
  next_.resize(labels_.size() * states);
  first_.assign(labels_.size() * states + 1, 0);
  for (std::size_t label = 0; label < labels_.size(); ++label) {
    for (std::uint32_t state = 0; state < states; ++state) {
      const std::uint32_t next = automaton_.next(state, labels_[label]);
      next_[label * states + state] = next;
      ++first_[label * states + next + 1];
    }
  }
  for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
  before_.resize(first_.back());
  std::vector<std::uint32_t> place(first_.begin(), first_.end() - 1);
  for (std::size_t label = 0; label < labels_.size(); ++label)
    for (std::uint32_t state = 0; state < states; ++state)
      before_[place[label * states + next_[label * states + state]]++] = state;
}

// Dijkstra's search from all accepting states backwards.
void Guide::find_ways() {
  using Open = std::pair<double, std::size_t>;
  const std::size_t states = automaton_.size();
  to_go_m_.assign(map_.regions().size() * states, kNever);
  successor_.assign(to_go_m_.size(), 0);
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  for (std::uint32_t region = 0; region < map_.regions().size(); ++region) {
    for (std::uint32_t state = 0; state < states; ++state) {
      if (!automaton_.accepting(state)) continue;
      to_go_m_[index(region, state)] = 0.0;
      successor_[index(region, state)] = index(region, state);
      open.emplace(0.0, index(region, state));
    }
  }
  while (!open.empty()) {
    const auto [known_m, node] = open.top();
    open.pop();
    if (known_m > to_go_m_[node]) continue;
    const auto region = static_cast<std::uint32_t>(node / states);
    const auto state = static_cast<std::uint32_t>(node % states);
    const auto reach = [&](std::uint32_t from, std::uint32_t before, double side) {
      const std::size_t earlier = index(from, before);
      if (known_m + side >= to_go_m_[earlier]) return;
      to_go_m_[earlier] = known_m + side;
      successor_[earlier] = node;
      open.emplace(known_m + side, earlier);
    };
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = map_.region(region).across[k];
      if (from == kNoRegion) continue;
      const double side = side_m(region, k);
      if (label_of_[from] == label_of_[region]) {
        reach(from, state, side);
        continue;
      }
      const std::size_t row = label_of_[region] * states + state;
      for (std::uint32_t at = first_[row]; at < first_[row + 1]; ++at) reach(from, before_[at], side);
    }
  }
}

std::vector<Stage> Guide::way(std::uint32_t region, std::uint32_t state) const {
  std::vector<Stage> stages;
  if (to_go_m(region, state) == kNever) return stages;
  std::size_t node = index(region, state);
  while (true) {
    stages.push_back({static_cast<std::uint32_t>(node / automaton_.size()),
                      static_cast<std::uint32_t>(node % automaton_.size())});
    if (successor_[node] == node) return stages;
    node = successor_[node];
  }
}

}  // namespace stepwright::ltl
