#pragma once

// Answer of a peer to one request, on the wire, and what the request changed. Plain values; any thread.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace stepwright::modbus::oracle {

using Bytes = std::vector<std::uint8_t>;

enum class Reaction : std::uint8_t {
  Answered,
  Silent,  // no answer, but the peer goes on
  Raised,  // an exception of its language: the connection ends
};

struct Answer {
  Reaction reaction = Reaction::Silent;
  Bytes pdu;
  std::string changes;  // as tables.h writes them

  bool operator==(const Answer&) const = default;
  // The exception code of an answer that is one, else 0.
  unsigned exception() const { return pdu.size() == 2 && pdu[0] >= 0x80 ? pdu[1] : 0; }
};

std::string hex(const Bytes& bytes);
Bytes from_hex(const std::string& text);
std::string to_string(const Answer& answer);

}  // namespace stepwright::modbus::oracle
