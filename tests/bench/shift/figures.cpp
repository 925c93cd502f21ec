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

namespace {

double now_s(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

double cpu_s() {
  return now_s(CLOCK_THREAD_CPUTIME_ID);
}

double process_cpu_s() {
  return now_s(CLOCK_PROCESS_CPUTIME_ID);
}

}  // namespace stepwright::bench::shift
