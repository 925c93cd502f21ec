#pragma once

// Frames of the socket fuzz: every function code to every unit, seeds and their mutations, frames with wrong
// lengths, several at once, half of one. One thread; the same seed gives the same frames.

#include <cstdint>
#include <random>
#include <vector>

#include "tests/fuzz/modbus/seeds.h"

namespace stepwright::fuzz::modbus {

// How a stream ends, as the framing of Modbus/TCP has it (Messaging on TCP/IP Implementation Guide
// V1.0b, 3.1.3).
enum class Ending : std::uint8_t {
  Clean,
  Half,  // in the middle of a frame
  Bad,   // in what is no frame: the connection cannot go on
};

struct Burst {
  std::vector<Bytes> pieces;  // sent one by one
  unsigned frames = 0;        // that it has, as they were meant
  unsigned whole = 0;         // that are whole, before its end
  Ending ending = Ending::Clean;
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
