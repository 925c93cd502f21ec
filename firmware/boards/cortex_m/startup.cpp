// From reset to main: memory as C++ expects it, the FPU where there is one. The board's vector table names
// reset_handler; its linker script gives the symbols.

#include <cstdint>
#include <cstring>

#include "firmware/boards/cortex_m/registers.h"

extern "C" {
extern std::uint32_t stack_bottom_, stack_top_, data_load_, data_begin_, data_end_, bss_begin_, bss_end_;

int main();

// No destructor of anything that lives as long as the board is ever run.
int __aeabi_atexit(void*, void (*)(void*), void*) {
  return 0;
}
}

namespace stepwright::boards {

// What the stack has not reached keeps this value, so that its depth can be read.
inline constexpr std::uint32_t kStackPaint = 0x57415246;

void paint_stack() {
  std::uint32_t here = 0;
  for (volatile std::uint32_t* at = &stack_bottom_; at + 16 < &here; ++at) *at = kStackPaint;
}

}  // namespace stepwright::boards

extern "C" [[noreturn]] void reset_handler() {
#ifdef __ARM_FP
  stepwright::boards::reg(stepwright::boards::kCoprocessors) |= 0xFu << 20;
  asm volatile("dsb\n isb" ::: "memory");
#endif
  stepwright::boards::paint_stack();
  std::memcpy(&data_begin_, &data_load_, (&data_end_ - &data_begin_) * sizeof(std::uint32_t));
  std::memset(&bss_begin_, 0, (&bss_end_ - &bss_begin_) * sizeof(std::uint32_t));
  main();
  stepwright::boards::reset_system();
}
