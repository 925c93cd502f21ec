#include "ladder/graphic/token_net.h"

#include <algorithm>
#include <numeric>

namespace stepwright::graphic {
namespace {

std::vector<std::uint32_t> numbers_of(const std::vector<StepId>& ids) {
  std::vector<std::uint32_t> numbers;
  for (const StepId id : ids) numbers.push_back(id.value);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

bool includes(const std::vector<std::uint32_t>& all, const std::vector<std::uint32_t>& part) {
  return std::includes(all.begin(), all.end(), part.begin(), part.end());
}

}  // namespace

TokenNet token_net(const SfcChart& chart) {
  TokenNet net;
  net.places = chart.steps.size();
  net.busy.assign(net.places, false);
  for (std::size_t i = 0; i < chart.steps.size(); ++i) {
    if (chart.steps[i].initial) net.marked.push_back(static_cast<std::uint32_t>(i));
  }
  std::vector<std::uint32_t> order(chart.transitions.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return chart.transitions[a].priority < chart.transitions[b].priority;
  });
  std::vector<std::vector<std::uint32_t>> certain(
      net.places);  // by first source: transitions that always fire
  for (const std::uint32_t index : order) {
    const Transition& transition = chart.transitions[index];
    NetTransition entry{numbers_of(transition.sources), numbers_of(transition.targets), index};
    bool shut_out = false;
    for (const std::uint32_t place : entry.sources) {
      for (const std::uint32_t before : certain[place]) {
        shut_out = shut_out || includes(entry.sources, net.transitions[before].sources);
      }
    }
    if (shut_out) continue;
    if (transition.condition.kind == ConditionKind::True) {
      certain[entry.sources.front()].push_back(static_cast<std::uint32_t>(net.transitions.size()));
    }
    net.transitions.push_back(std::move(entry));
  }
  return net;
}

}  // namespace stepwright::graphic
