#pragma once

// What the socket fuzz sends: every function code to every unit, seeds and their mutations, frames with wrong
// lengths, several at once, half of one.

#include <random>
#include <vector>

#include "tests/fuzz/modbus/seeds.h"

namespace stepwright::fuzz::modbus {

struct Burst {
  std::vector<Bytes> pieces;  // sent one by one
  unsigned frames = 0;        // that it has, as they were meant
};

class SocketFrames {
 public:
  SocketFrames(std::vector<Seed> seeds, std::uint32_t seed) : seeds_(std::move(seeds)), random_(seed) {}

  Burst next();

 private:
  std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }
  Bytes any_pdu();
  Bytes any_frame();
  Bytes wrong_length(Bytes frame);

  std::vector<Seed> seeds_;
  std::mt19937 random_;
  unsigned turn_ = 0;  // goes through all function codes and units
};

}  // namespace stepwright::fuzz::modbus
