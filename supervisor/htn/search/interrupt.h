#pragma once

// End of a search from outside: a deadline, and somebody who cancels it.
//
// Thread rule: one search, one object; the flag may be set by any thread.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>

namespace stepwright::htn {

class Interrupt {
 public:
  Interrupt(std::optional<std::chrono::steady_clock::time_point> until, const std::atomic<bool>* cancel)
      : until_(until), cancel_(cancel) {}

  // Called for every bit of work; looks at the clock now and then. True from when the search has to end.
  bool poll() {
    constexpr std::uint32_t kWorkPerLook = 256;
    if (++work_ % kWorkPerLook == 0) look();
    return stopped_;
  }
  void look() {
    if (cancel_ != nullptr && cancel_->load(std::memory_order_relaxed)) stopped_ = cancelled_ = true;
    if (until_ && std::chrono::steady_clock::now() >= *until_) stopped_ = true;
  }
  bool stopped() const { return stopped_; }
  bool cancelled() const { return cancelled_; }

 private:
  std::optional<std::chrono::steady_clock::time_point> until_;
  const std::atomic<bool>* cancel_;
  std::uint32_t work_ = 0;
  bool stopped_ = false;
  bool cancelled_ = false;
};

}  // namespace stepwright::htn
