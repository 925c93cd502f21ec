#pragma once

// Registers of a Cortex-M core and what is done with them (ARMv7-M Architecture Reference Manual, B3).

#include <cstdint>

namespace stepwright::boards {

inline volatile std::uint32_t& reg(std::uintptr_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}

inline constexpr std::uintptr_t kSysTickControl = 0xE000E010;
inline constexpr std::uintptr_t kSysTickReload = 0xE000E014;
inline constexpr std::uintptr_t kSysTickValue = 0xE000E018;
inline constexpr std::uintptr_t kInterruptSetEnable = 0xE000E100;  // of interrupts 0 to 31
inline constexpr std::uintptr_t kInterruptControl = 0xE000ED04;    // ICSR
inline constexpr std::uintptr_t kResetControl = 0xE000ED0C;        // AIRCR
inline constexpr std::uintptr_t kCoprocessors = 0xE000ED88;        // CPACR

inline constexpr std::uint32_t kSysTickPending = 1u << 26;  // of ICSR

inline void disable_interrupts() {
  asm volatile("cpsid i" ::: "memory");
}
inline void enable_interrupts() {
  asm volatile("cpsie i" ::: "memory");
}
// Sleeps until an interrupt is pending, whether interrupts are enabled or not.
inline void wait_for_interrupt() {
  asm volatile("wfi" ::: "memory");
}

[[noreturn]] inline void reset_system() {
  asm volatile("dsb" ::: "memory");
  reg(kResetControl) = 0x05FA0004;
  for (;;) wait_for_interrupt();
}

// Turns interrupts off for its lifetime, for data that an interrupt and the main loop share.
class InterruptsOff {
 public:
  InterruptsOff() { disable_interrupts(); }
  ~InterruptsOff() { enable_interrupts(); }
  InterruptsOff(const InterruptsOff&) = delete;
  InterruptsOff& operator=(const InterruptsOff&) = delete;
};

}  // namespace stepwright::boards
