#pragma once

// Time of a process as that of a board, and its rest: until something arrives at a descriptor.

#include <poll.h>

#include <ctime>

#include "firmware/port/tick.h"

namespace stepwright::boards {

class HostTick final : public port::Tick {
 public:
  // Time begins now; `line` becomes readable when a master says something.
  explicit HostTick(int line) : line_(line), started_ns_(clock_ns()) {}

  // As after a reset.
  void restart() { started_ns_ = clock_ns(); }

  std::int64_t now_ns() override { return clock_ns() - started_ns_; }
  void rest() override {
    pollfd wait{line_, POLLIN, 0};
    ::poll(&wait, 1, 1);
  }

 private:
  static std::int64_t clock_ns() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
  }

  int line_;
  std::int64_t started_ns_;
};

}  // namespace stepwright::boards
