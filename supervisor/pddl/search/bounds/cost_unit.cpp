#include "supervisor/pddl/search/bounds/cost_unit.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stepwright::pddl {

// Costs are sums of decimals: they are taken in hundredths.
double common_unit(std::span<const double> costs) {
  constexpr double kGrid = 100.0;
  long long unit = 0;
  for (const double cost : costs) {
    const double scaled = cost * kGrid;
    if (!(scaled < 1e12) || std::abs(scaled - std::nearbyint(scaled)) > 1e-6) return 0.0;
    long long a = unit, b = std::llround(scaled);
    while (b != 0) {
      a %= b;
      std::swap(a, b);
    }
    unit = a;
  }
  return static_cast<double>(unit) / kGrid;
}

double rounded_up(double bound, double unit) {
  constexpr double kRounding = 1e-5;
  if (unit <= 0.0 || !std::isfinite(bound)) return bound;
  return std::max(0.0, std::ceil(bound / unit - kRounding)) * unit;
}

}  // namespace stepwright::pddl
