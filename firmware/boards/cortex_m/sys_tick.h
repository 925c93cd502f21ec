#pragma once

// Time from SysTick: an interrupt every millisecond, and the counter between two of them.

#include "firmware/boards/cortex_m/registers.h"
#include "firmware/port/tick.h"

namespace stepwright::boards {

// Whether data wait; rest() asks with interrupts off, so that it does not sleep over new data.
class Waiting {
 public:
  virtual bool waiting() const = 0;

 protected:
  ~Waiting() = default;
};

class SysTick final : public port::Tick {
 public:
  // `hertz`: of the core's clock; a multiple of 1000 and below 2^24 * 1000.
  SysTick(std::uint32_t hertz, const Waiting& line) : hertz_(hertz), line_(line) {
    reg(kSysTickReload) = hertz / 1000 - 1;
    reg(kSysTickValue) = 0;
    reg(kSysTickControl) = 7;  // the core's clock, with interrupt
  }

  // By the interrupt.
  void millisecond() { milliseconds_ = milliseconds_ + 1; }

  std::int64_t now_ns() override {
    const InterruptsOff off;
    std::uint64_t ms = milliseconds_;
    std::uint32_t left = reg(kSysTickValue);
    if ((reg(kInterruptControl) & kSysTickPending) != 0) {
      left = reg(kSysTickValue);
      ++ms;
    }
    const std::uint64_t ticks = hertz_ / 1000 - 1 - left;
    return static_cast<std::int64_t>(ms * 1'000'000 + ticks * 1'000'000 / (hertz_ / 1000));
  }

  void rest() override {
    const InterruptsOff off;
    if (!line_.waiting()) wait_for_interrupt();
  }

 private:
  std::uint32_t hertz_;
  const Waiting& line_;
  volatile std::uint64_t milliseconds_ = 0;
};

}  // namespace stepwright::boards
