#pragma once

// What the firmware needs of a board; a new board implements these and links the rest as it is
// (firmware/README.md).

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
