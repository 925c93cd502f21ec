#include "supervisor/pddl/search/search_control.h"

#include <algorithm>

namespace stepwright::pddl {

SearchControl::SearchControl(std::chrono::milliseconds time, std::size_t memory_mb,
                             const std::atomic<bool>* cancel)
    : start_(Clock::now()),
      next_report_(start_ + std::chrono::seconds(1)),
      time_(time),
      memory_mb_(memory_mb),
      cancel_(cancel) {}

StopReason SearchControl::check(std::size_t memory) {
  const double mb = static_cast<double>(memory + other_memory) / (1024.0 * 1024.0);
  peak_mb = std::max(peak_mb, mb);
  const Clock::time_point now = Clock::now();
  if (now >= next_report_) {
    next_report_ = now + std::chrono::seconds(1);
    if (on_second) on_second(bound);
  }
  if (cancel_ != nullptr && cancel_->load(std::memory_order_relaxed)) return StopReason::Cancelled;
  if (time_.count() > 0 && now - start_ >= time_) return StopReason::Time;
  if (memory_mb_ > 0 && mb >= static_cast<double>(memory_mb_)) return StopReason::Memory;
  return StopReason::None;
}

double SearchControl::elapsed_ms() const {
  return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
}

bool SearchControl::offer(std::vector<int> operators, double cost, std::uint32_t steps) {
  const double rounded = comparable(cost);
  if (best_.beats(rounded, steps) || (best_.cost == rounded && best_.steps == steps)) return false;
  best_ = {std::move(operators), rounded, steps};
  if (on_improvement) on_improvement();
  return true;
}

}  // namespace stepwright::pddl
