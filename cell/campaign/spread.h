#pragma once

// The runs of a campaign over threads: which of them takes which run is left to chance, what comes of it is
// not.
//
//   figures.wall_s = spread(runs, threads, told, cancel, [](std::uint64_t i) { return run_line(i); },
//                           [&](LineRun run) { add(run, figures); });

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace stepwright::campaign {

// `run(i)` for i = 0 .. runs - 1, each on one of `threads`; what it returns is given to `take`, one at a
// time. `told` (may be empty) hears now and then how many are done, and never beside `take`. Once `cancel`
// (may be null) is set no further run begins. Returns seconds.
template <typename Run, typename Take>
double spread(std::uint64_t runs, unsigned threads, const std::function<void(std::uint64_t done)>& told,
              const std::atomic<bool>* cancel, const Run& run, const Take& take) {
  constexpr std::chrono::milliseconds kBetweenWords{200};
  const auto start = std::chrono::steady_clock::now();
  std::mutex mutex;  // of `take`, `told` and the next two
  std::uint64_t done = 0;
  auto last_word = start;
  std::atomic<std::uint64_t> next{0};
  const auto work = [&] {
    for (std::uint64_t i = next++; i < runs && (cancel == nullptr || !*cancel); i = next++) {
      auto result = run(i);
      const std::lock_guard lock(mutex);
      take(std::move(result));
      ++done;
      const auto now = std::chrono::steady_clock::now();
      if (!told || (done != 1 && done != runs && now - last_word < kBetweenWords)) continue;
      last_word = now;
      told(done);
    }
  };
  {
    std::vector<std::jthread> workers;
    for (unsigned i = 0; i < threads; ++i) workers.emplace_back(work);
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace stepwright::campaign
