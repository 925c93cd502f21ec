#pragma once

// The time and the flag that end all of a planning. A value that does not change; any thread.

#include <algorithm>
#include <atomic>
#include <chrono>

#include "supervisor/ltl/route/stop.h"

namespace stepwright::ltl {

class Deadline {
 public:
  Deadline(double most_s, const std::atomic<bool>* cancel) : most_s_(most_s), cancel_(cancel) {}

  double left_s() const {
    return most_s_ - std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  }
  bool is_cancelled() const { return cancel_ != nullptr && cancel_->load(); }
  bool over() const { return is_cancelled() || !(left_s() > 0.0); }
  Stop stop() const {
    constexpr double kLongest_s = 1e6;  // more would overflow some clocks
    const std::chrono::duration<double> most(std::clamp(most_s_, 0.0, kLongest_s));
    return {began_ + std::chrono::duration_cast<std::chrono::steady_clock::duration>(most), cancel_, nullptr};
  }

 private:
  const double most_s_;
  const std::atomic<bool>* const cancel_;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

}  // namespace stepwright::ltl
