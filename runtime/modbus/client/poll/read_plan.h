#pragma once

// Plan of the requests that read the inputs of a group: as few as the limits of the protocol and of the slave
// allow. Objects nobody asked for are read along where that saves a request. Pure; any thread.

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/modbus/client/tag.h"

namespace stepwright::modbus::client {

struct ReadLimits {
  std::uint16_t max_gap = 8;  // registers; 16 times as many bits
  std::uint16_t max_registers = 125;
  std::uint16_t max_bits = 2'000;
};

struct ReadRequest {
  Table table = Table::HoldingRegisters;
  std::uint16_t first = 0;
  std::uint16_t count = 0;
  std::vector<std::uint32_t> tags;  // indices, by address
};

// `tags` may overlap and stand in any order. No request is longer than the limits, and no tag is divided.
std::vector<ReadRequest> plan_reads(std::span<const Tag> tags, const ReadLimits& limits);

// Two requests for one that the slave refuses as a whole; nothing for one of a single tag.
std::vector<ReadRequest> halves_of(const ReadRequest& request, std::span<const Tag> tags);

}  // namespace stepwright::modbus::client
