#pragma once

// The board's time. Called by the main loop only.

#include <cstdint>

namespace stepwright::port {

class Tick {
 public:
  // Nanoseconds since the board started; never goes back.
  virtual std::int64_t now_ns() = 0;

  // Lets the processor rest until something happened on the line or a millisecond is over. May return sooner.
  virtual void rest() = 0;

 protected:
  ~Tick() = default;
};

}  // namespace stepwright::port
