#pragma once

// A clock that goes on only while the machine gives threads their turn: it counts how often a thread comes
// round that sleeps for a millisecond each time. A bound of the product's own time holds by it on a busy
// machine, too; by the wall's clock it may be exceeded there through no fault of the product.
//
//   const GivenTime given;
//   const double begin_ms = given.ms();
//   ...
//   EXPECT_LT(given.ms() - begin_ms, 1'000.0);
//
// Never ahead of the wall's clock. Threads: any.

#include <atomic>
#include <chrono>
#include <thread>

namespace stepwright::support {

class GivenTime {
 public:
  GivenTime()
      : thread_([this](const std::stop_token& stop) {
          while (!stop.stop_requested()) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            rounds_.fetch_add(1);
          }
        }) {}

  double ms() const { return static_cast<double>(rounds_.load()); }

 private:
  std::atomic<long> rounds_{0};
  std::jthread thread_;
};

}  // namespace stepwright::support
