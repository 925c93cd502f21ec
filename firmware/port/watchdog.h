#pragma once

// The hardware that resets the board when the main loop does not come round. Called by the main loop only.

#include <cstdint>

namespace stepwright::port {

class Watchdog {
 public:
  // From now on the board is reset unless feed() comes at least every `period_ms`.
  virtual void start(std::uint32_t period_ms) = 0;
  virtual void feed() = 0;

  // How often it has reset the board since power-on, and whether this start is such a reset.
  virtual std::uint16_t resets() const = 0;
  virtual bool caused_this_start() const = 0;

 protected:
  ~Watchdog() = default;
};

}  // namespace stepwright::port
