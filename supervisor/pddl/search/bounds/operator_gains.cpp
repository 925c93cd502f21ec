#include "supervisor/pddl/search/bounds/operator_gains.h"

#include <algorithm>
#include <cmath>

namespace stepwright::pddl {
namespace {

double gained(double amount) {
  return std::isnan(amount) ? kInfinity : std::max(0.0, amount);
}

}  // namespace

// The units of an operator follow each other, and movers are in the order of their units.
OperatorGains::OperatorGains(const RelaxedTask& task) : task_(task), gains_(task.comparisons()) {
  for (std::size_t c = 0; c < gains_.size(); ++c) {
    std::vector<Entry>& list = gains_[c];
    for (const Mover& mover : task.movers_of(c)) {
      const int op = task.operator_of(static_cast<std::size_t>(mover.unit));
      if (list.empty() || list.back().op != op) list.push_back({op, {}});
      list.back().gains.up += gained(mover.gain.high);
      list.back().gains.down += gained(-mover.gain.low);
    }
  }
}

Gains OperatorGains::of(const Mover& mover) const {
  const auto& list = gains_[static_cast<std::size_t>(mover.atom) - task_.first_comparison()];
  const int op = task_.operator_of(static_cast<std::size_t>(mover.unit));
  return std::lower_bound(list.begin(), list.end(), op, [](const Entry& e, int o) { return e.op < o; })
      ->gains;
}

std::vector<double> OperatorGains::alike(bool upwards) const {
  std::vector<double> all;
  for (const auto& list : gains_) {
    double common = 0.0;
    for (const Entry& entry : list) {
      const double amount = upwards ? entry.gains.up : entry.gains.down;
      if (amount == 0.0 || amount == common) continue;
      common = common == 0.0 ? amount : kInfinity;
    }
    all.push_back(common == kInfinity ? 0.0 : common);
  }
  return all;
}

}  // namespace stepwright::pddl
