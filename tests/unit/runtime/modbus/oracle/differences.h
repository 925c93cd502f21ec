#pragma once

// Differences between a peer and us, each with its reason: runtime/doc/modbus_differences.md has the same
// list. What is not in it is a fault, of us or of the test.

#include <span>
#include <string_view>

#include "tests/unit/runtime/modbus/oracle/answer.h"

namespace stepwright::modbus::oracle {

enum class Peer : std::uint8_t { Libmodbus, Pymodbus };

struct Seen {
  const Bytes& request;
  const Answer& ours;
  const Answer& theirs;
};

struct Difference {
  std::string_view id;  // of the document: "L1", "P3"
  Peer peer;
  bool (*explains)(const Seen&);
};

std::span<const Difference> differences();

}  // namespace stepwright::modbus::oracle
