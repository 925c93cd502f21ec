#include "tests/unit/runtime/modbus/oracle/answer.h"

#include <cstdio>

namespace stepwright::modbus::oracle {

std::string hex(const Bytes& bytes) {
  std::string out;
  for (const std::uint8_t each : bytes) {
    char text[3];
    std::snprintf(text, sizeof text, "%02x", each);
    out += text;
  }
  return out;
}

Bytes from_hex(const std::string& text) {
  Bytes out;
  for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
    out.push_back(static_cast<std::uint8_t>(std::stoul(text.substr(i, 2), nullptr, 16)));
  }
  return out;
}

std::string to_string(const Answer& answer) {
  std::string out = answer.reaction == Reaction::Answered ? hex(answer.pdu)
                    : answer.reaction == Reaction::Silent ? "silence"
                                                          : "ends the connection";
  if (!answer.changes.empty()) out += ", changes " + answer.changes.substr(0, 120);
  return out;
}

}  // namespace stepwright::modbus::oracle
