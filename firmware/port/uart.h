#pragma once

// The serial line of the board. Reception is by interrupt into a ring of the driver, so that a scan loses no
// byte; sending takes what has room and goes on by itself.
//
// Called by the main loop only; neither function waits.

#include <cstddef>
#include <span>

namespace stepwright::port {

class Uart {
 public:
  // Takes bytes that have arrived; how many.
  virtual std::size_t read(std::span<std::byte> bytes) = 0;

  // Gives bytes to be sent; how many were taken.
  virtual std::size_t write(std::span<const std::byte> bytes) = 0;

 protected:
  ~Uart() = default;
};

}  // namespace stepwright::port
