#pragma once

// The seeds of seeds.txt as bytes.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace stepwright::fuzz::modbus {

using Bytes = std::vector<std::uint8_t>;

inline constexpr std::uint8_t kAddress = 0x11;  // of the slave that the framed seeds go to

struct Seed {
  std::string name;
  Bytes bytes;
};

struct Seeds {
  std::vector<Seed> tcp;  // streams
  std::vector<Seed> rtu;  // what comes over a line
};

// Throws std::runtime_error with the line that cannot be read.
Seeds read_seeds(const std::filesystem::path& file);

// A PDU in the frame of either.
Bytes tcp_frame(const Bytes& pdu, std::uint16_t transaction);
Bytes rtu_frame(const Bytes& pdu, std::uint8_t address);

}  // namespace stepwright::fuzz::modbus
