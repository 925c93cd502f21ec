#pragma once

// The watchdog of ARM's Cortex-M System Design Kit (DDI 0479, 4.5). Its counter has half the period. When it
// runs out it raises the NMI, which resets the board if the main loop has not come round since the last one;
// if even that does not run, the hardware resets when it runs out again.
//
// The first NMI after a sign of life is no proof that the loop hangs: who holds up the whole machine (an
// emulator that gets no processor, a debugger) stops the loop and lets the time go on.

#include "firmware/boards/cortex_m/registers.h"
#include "firmware/port/watchdog.h"

namespace stepwright::boards {

// In memory that a reset leaves alone. After power-on the magic number is missing.
struct ResetNotes {
  std::uint32_t magic;
  std::uint16_t resets;
  std::uint16_t bitten;
};

class CmsdkWatchdog final : public port::Watchdog {
 public:
  CmsdkWatchdog(std::uintptr_t base, std::uint32_t hertz, ResetNotes& notes)
      : base_(base), hertz_(hertz), notes_(notes) {
    if (notes_.magic != kMagic) notes_ = {kMagic, 0, 0};
    caused_ = notes_.bitten != 0;
    if (caused_) ++notes_.resets;
    notes_.bitten = 0;
  }

  void start(std::uint32_t period_ms) override {
    reg(base_ + kLock) = kUnlocked;
    reg(base_ + kLoad) = hertz_ / 1000 * (period_ms / 2);
    reg(base_ + kControl) = 0b11;  // interrupt and reset
  }
  void feed() override {
    fed_ = true;
    reload();
  }

  // By the NMI.
  void expired() {
    if (!fed_) {
      notes_.bitten = 1;
      reset_system();
    }
    fed_ = false;
    reload();
  }

  std::uint16_t resets() const override { return notes_.resets; }
  bool caused_this_start() const override { return caused_; }

 private:
  static constexpr std::uintptr_t kLoad = 0x00, kControl = 0x08, kInterruptClear = 0x0C, kLock = 0xC00;
  static constexpr std::uint32_t kUnlocked = 0x1ACCE551;
  static constexpr std::uint32_t kMagic = 0x57445431;

  void reload() { reg(base_ + kInterruptClear) = 1; }

  std::uintptr_t base_;
  std::uint32_t hertz_;
  ResetNotes& notes_;
  bool caused_ = false;
  volatile bool fed_ = false;  // since the last NMI
};

}  // namespace stepwright::boards
