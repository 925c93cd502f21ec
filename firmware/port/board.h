#pragma once

// A board as the firmware sees it: the interfaces that a new board implements. The rest is linked as it is
// (firmware/README.md). Used by the main loop; what it refers to lives as long as the firmware.

#include <cstddef>
#include <span>

#include "firmware/port/flash.h"
#include "firmware/port/tick.h"
#include "firmware/port/uart.h"
#include "firmware/port/watchdog.h"

namespace stepwright::port {

struct Board {
  const char* name;  // "mps2-an385"; what Modbus tells as the product code
  Tick& tick;
  Uart& uart;
  Flash& flash;
  Watchdog& watchdog;
  // For programs: image, stack, and scratch of the verifier. Aligned to 8 bytes.
  std::span<std::byte> memory;
};

}  // namespace stepwright::port
