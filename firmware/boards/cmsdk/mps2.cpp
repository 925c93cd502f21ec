// The MPS2 boards: devices, interrupts, main.

#include "firmware/app/firmware.h"
#include "firmware/boards/cmsdk/cmsdk_uart.h"
#include "firmware/boards/cmsdk/cmsdk_watchdog.h"
#include "firmware/boards/cortex_m/sys_tick.h"
#include "firmware/boards/emulated/ram_flash.h"

// The board's folder gives its name.
#include STEPWRIGHT_BOARD_HEADER

extern "C" {
extern std::byte flash_begin_, flash_end_, memory_begin_, memory_end_;
extern std::uint32_t stack_top_;
[[noreturn]] void reset_handler();
}

namespace stepwright::boards {
namespace {

constexpr std::uint32_t kHertz = 25'000'000;  // of the core and the peripherals
constexpr std::uint32_t kBaud = 115'200;
constexpr std::uintptr_t kUart0 = 0x40004000;
constexpr std::uintptr_t kWatchdog = 0x40008000;

[[gnu::section(".noinit")]] ResetNotes reset_notes;

// What interrupts reach: hardware has one of each. Set once, before interrupts are on.
struct Devices {
  CmsdkUart* uart = nullptr;
  SysTick* tick = nullptr;
  CmsdkWatchdog* watchdog = nullptr;
};
Devices devices;

void tick_handler() {
  devices.tick->millisecond();
}
void receive_handler() {
  devices.uart->received();
}
void transmit_handler() {
  devices.uart->sent();
}
void watchdog_handler() {
  if (devices.watchdog == nullptr) reset_system();
  devices.watchdog->expired();
}
// A fault of the firmware itself: the watchdog ends it.
void fault_handler() {
  for (;;) {
  }
}

using Handler = void (*)();
struct Vectors {
  const void* stack;
  Handler handlers[17];
};

[[gnu::section(".vectors"), gnu::used]] const Vectors vectors = {
    &stack_top_,
    {&reset_handler, watchdog_handler, fault_handler, fault_handler, fault_handler, fault_handler, nullptr,
     nullptr, nullptr, nullptr, fault_handler, fault_handler, nullptr, fault_handler, tick_handler,
     receive_handler, transmit_handler}};

}  // namespace
}  // namespace stepwright::boards

int main() {
  using namespace stepwright;
  boards::disable_interrupts();
  static boards::CmsdkUart uart(boards::kUart0, boards::kHertz / boards::kBaud);
  static boards::SysTick tick(boards::kHertz, uart);
  static boards::CmsdkWatchdog watchdog(boards::kWatchdog, boards::kHertz, boards::reset_notes);
  static boards::RamFlash flash({&flash_begin_, &flash_end_});
  static port::Board board{boards::kBoardName, tick, uart, flash, watchdog, {&memory_begin_, &memory_end_}};
  boards::devices = {&uart, &tick, &watchdog};
  boards::reg(boards::kInterruptSetEnable) = 0b11;  // of the UART
  boards::enable_interrupts();
  static app::Firmware firmware(board);
  firmware.boot();
  for (;;) firmware.turn();
}
