#pragma once

// Any bytes through the slave's framing and engine, in pieces, as a socket or a line brings them. Input and
// output lie against guard pages; every answer is judged; afterwards a valid request must be answered as
// ever.

#include <cstdint>
#include <span>
#include <string>

#include "tests/fuzz/guarded.h"

namespace stepwright::fuzz::modbus {

struct Run {
  std::size_t frames = 0;   // that were taken
  std::size_t answers = 0;  // of them normal ones
  std::string finding;      // what is wrong; empty if nothing is
};

// `pieces` decides where the stream is cut. The stream ends at the first bad frame, as a connection does.
Run run_tcp(std::span<const std::uint8_t> stream, std::uint32_t pieces, Side side);
Run run_rtu(std::span<const std::uint8_t> line, Side side);

}  // namespace stepwright::fuzz::modbus
