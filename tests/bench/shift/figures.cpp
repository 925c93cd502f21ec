#include "tests/bench/shift/figures.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numeric>

namespace stepwright::bench::shift {

double Times::quantile(double q) const {
  if (ms.empty()) return 0.0;
  std::vector<double> sorted = ms;
  std::ranges::sort(sorted);
  return sorted[static_cast<std::size_t>(std::floor(q * static_cast<double>(sorted.size() - 1) + 0.5))];
}

double Times::sum() const {
  return std::accumulate(ms.begin(), ms.end(), 0.0);
}

double cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace stepwright::bench::shift
