#pragma once

// Measured time of a piece of work, on a machine that others use, too. One thread.

#include <algorithm>
#include <ctime>

namespace stepwright::bench {

// Seconds of the processor, the best of five rounds.
template <typename Work>
double processor_seconds(const Work& work) {
  double best = 1e9;
  for (int k = 0; k < 5; ++k) {
    const std::clock_t begin = std::clock();
    work();
    best = std::min(best, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return best;
}

}  // namespace stepwright::bench
