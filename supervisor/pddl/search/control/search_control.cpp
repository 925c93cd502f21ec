#include "supervisor/pddl/search/control/search_control.h"

#include <algorithm>

#include "supervisor/pddl/search/control/resident_memory.h"

namespace stepwright::pddl {
namespace {

constexpr std::size_t kMegabyte = 1024 * 1024;
constexpr std::chrono::milliseconds kBetweenLooks{4};
// What a step of a plan takes with its names, as it leaves the planner; asked for before long plans are
// taken.
constexpr std::size_t kBytesPerStep = 256;
constexpr std::size_t kLongPlan = 50'000;

template <typename T>
void raise(std::atomic<T>& target, T value) {
  T now = target.load(std::memory_order_relaxed);
  while (now < value && !target.compare_exchange_weak(now, value, std::memory_order_relaxed)) {
  }
}

}  // namespace

SearchControl::SearchControl(std::chrono::milliseconds time, std::size_t memory_mb,
                             const std::atomic<bool>* cancel, std::uint64_t most_states)
    : owner_(std::this_thread::get_id()),
      start_(Clock::now()),
      next_report_(start_ + std::chrono::seconds(1)),
      time_(time),
      memory_limit_(memory_mb == 0 ? SIZE_MAX : memory_mb * kMegabyte),
      most_states_(most_states),
      resident_before_(resident_bytes()),
      next_look_((start_ + kBetweenLooks).time_since_epoch().count()),
      cancel_(cancel) {}

StopReason SearchControl::check() {
  const Clock::time_point now = Clock::now();
  if (std::this_thread::get_id() == owner_ && now >= next_report_) {
    next_report_ = now + std::chrono::seconds(1);
    if (on_second) on_second(best(), bound());
  }
  if (const StopReason reason = stopped_.load(std::memory_order_relaxed); reason != StopReason::None) {
    return reason;
  }
  const StopReason reason = ended(now);
  return reason == StopReason::None ? reason : stop(reason);
}

bool SearchControl::used_up() {
  return ended(Clock::now()) != StopReason::None;
}

StopReason SearchControl::ended(Clock::time_point now) {
  if (cancel_ != nullptr && cancel_->load(std::memory_order_relaxed)) return StopReason::Cancelled;
  if (most_states_ > 0 && expanded() >= most_states_) return StopReason::States;
  if (time_.count() > 0 && now - start_ >= time_) return StopReason::Time;
  return memory_used_up(now) ? StopReason::Memory : StopReason::None;
}

bool SearchControl::memory_used_up(Clock::time_point now) {
  if (memory_.load(std::memory_order_relaxed) >= memory_limit_) return true;
  if (now.time_since_epoch().count() < next_look_.load(std::memory_order_relaxed)) return false;
  next_look_.store((now + kBetweenLooks).time_since_epoch().count(), std::memory_order_relaxed);
  const std::size_t held = grown();
  raise(peak_, held);
  return held >= memory_limit_;
}

std::size_t SearchControl::grown() const {
  const std::size_t resident = resident_bytes();
  return resident > resident_before_ ? resident - resident_before_ : 0;
}

bool SearchControl::has_room_for(std::size_t bytes) const {
  if (memory_limit_ == SIZE_MAX) return true;
  const std::size_t held = std::max(grown(), memory_.load(std::memory_order_relaxed));
  return held < memory_limit_ && bytes < memory_limit_ - held;
}

// The first reason counts.
StopReason SearchControl::stop(StopReason reason) {
  StopReason expected = StopReason::None;
  return stopped_.compare_exchange_strong(expected, reason) ? reason : expected;
}

double SearchControl::elapsed_ms() const {
  return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
}

double SearchControl::peak_mb() const {
  return static_cast<double>(peak_.load(std::memory_order_relaxed)) / static_cast<double>(kMegabyte);
}

bool SearchControl::offer(std::vector<int> operators, double cost) {
  const double rounded = comparable(cost);
  const auto steps = static_cast<std::uint32_t>(operators.size());
  if (steps > kLongPlan && !has_room_for(steps * kBytesPerStep)) {
    stop(StopReason::Memory);
    return false;
  }
  const std::lock_guard lock(mutex_);
  if (!best_.quality.leaves_room_for(rounded, steps)) return false;
  best_ = {std::move(operators), {rounded, steps}};
  version_.fetch_add(1, std::memory_order_release);
  if (on_improvement) on_improvement(best_);
  return true;
}

Incumbent SearchControl::best() const {
  const std::lock_guard lock(mutex_);
  return best_;
}

void SearchControl::raise_bound(double bound) {
  raise(bound_, bound);
}

void MemoryShare::set(std::size_t bytes) {
  if (bytes == bytes_) return;
  const std::size_t total =
      control_.memory_.fetch_add(bytes - bytes_, std::memory_order_relaxed) + bytes - bytes_;
  bytes_ = bytes;
  raise(control_.peak_, total);
}

}  // namespace stepwright::pddl
