#include "cell/runtime/io_restart.h"

namespace stepwright::cell_runtime {

void IoRestart::lost() {
  waits_ = config_.automatic;
  exhausted_ = false;
  there_ = false;
}

bool IoRestart::due(bool alive, Clock::time_point now) {
  constexpr std::chrono::hours kWindow{1};
  if (!waits_) return false;
  if (!alive) {
    there_ = false;
    return false;
  }
  if (!there_) {
    there_ = true;
    there_since_ = now;
  }
  if (now - there_since_ < config_.after) return false;
  while (!starts_.empty() && now - starts_.front() >= kWindow) starts_.pop_front();
  waits_ = false;
  exhausted_ = starts_.size() >= config_.limit;
  if (!exhausted_) starts_.push_back(now);
  return !exhausted_;
}

}  // namespace stepwright::cell_runtime
