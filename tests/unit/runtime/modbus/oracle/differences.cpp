#include "tests/unit/runtime/modbus/oracle/differences.h"

#include <algorithm>
#include <array>

namespace stepwright::modbus::oracle {

namespace {

constexpr unsigned kIdentification = 0x0E;  // the MEI type of FC 43 that is served

bool is_normal(const Answer& answer) {
  return answer.reaction == Reaction::Answered && answer.exception() == 0;
}

bool exceptions(const Seen& seen, unsigned ours, unsigned theirs) {
  return seen.ours.exception() == ours && seen.theirs.exception() == theirs;
}

unsigned word(const Bytes& request, std::size_t at) {
  return static_cast<unsigned>(request[at] << 8 | request[at + 1]);
}

// How long the request should be by its function code and count; 0 if that cannot be told.
std::size_t right_length(const Bytes& request) {
  switch (request[0]) {
    case 15:
      return request.size() < 5 ? 0 : 6 + (word(request, 3) + 7) / 8;
    case 16:
      return request.size() < 5 ? 0 : 6 + word(request, 3) * 2;
    case 22:
      return 7;
    case 23:
      return request.size() < 9 ? 0 : 10 + word(request, 7) * 2;
    case 43:
      return 4;
    default:
      return 5;
  }
}

// Neither count nor byte count may contradict the bytes that are there.
bool length_is_wrong(const Seen& seen) {
  const Bytes& request = seen.request;
  if (request.size() != right_length(request)) return true;
  return request[0] == 23 && request.size() != 10u + request[9];
}

bool single_coil_value_is_wrong(const Seen& seen) {
  return seen.request[0] == 5 && seen.request.size() == 5 && seen.ours.exception() == 3;
}

// FC 15 with more data than its count needs.
bool has_spare_coils(const Seen& seen) {
  if (seen.request[0] != 15 || seen.request.size() < 6) return false;
  return seen.request[5] > (word(seen.request, 3) + 7) / 8;
}

bool same_but_for_conformity(const Seen& seen) {
  Bytes theirs = seen.theirs.pdu;
  if (seen.request[0] != 43 || theirs.size() < 4 || theirs[3] != 0x83) return false;
  theirs[3] = 0x82;
  return theirs == seen.ours.pdu;
}

bool is_of_pymodbus_only(unsigned function) {
  constexpr std::array<unsigned, 8> kFunctions{7, 8, 11, 12, 17, 20, 21, 24};
  return std::ranges::find(kFunctions, function) != kFunctions.end();
}

constexpr Difference kDifferences[] = {
    {"L1", Peer::Libmodbus,
     [](const Seen& seen) { return single_coil_value_is_wrong(seen) && seen.theirs.exception() == 2; }},
    {"L2", Peer::Libmodbus,
     [](const Seen& seen) {
       return has_spare_coils(seen) && seen.ours.exception() == 3 &&
              (is_normal(seen.theirs) || seen.theirs.exception() == 2);
     }},
    {"L3", Peer::Libmodbus,
     [](const Seen& seen) {
       return seen.request[0] == 17 && seen.ours.exception() == 1 && is_normal(seen.theirs);
     }},
    {"L4", Peer::Libmodbus,
     [](const Seen& seen) {
       return seen.request[0] == 7 && seen.ours.exception() == 1 && seen.theirs.reaction == Reaction::Silent;
     }},
    {"L5", Peer::Libmodbus,
     [](const Seen& seen) {
       const auto without_bit = static_cast<std::uint8_t>(seen.request[0] & 0x7F);
       return seen.request[0] >= 0x80 && seen.ours.exception() == 1 &&
              seen.theirs.pdu == Bytes{without_bit, 1};
     }},
    {"L6", Peer::Libmodbus,
     [](const Seen& seen) { return seen.request[0] == 43 && seen.theirs.exception() == 1; }},
    {"P1", Peer::Pymodbus,
     [](const Seen& seen) {
       return length_is_wrong(seen) && seen.ours.exception() == 3 && seen.theirs.reaction == Reaction::Raised;
     }},
    {"P2", Peer::Pymodbus,
     [](const Seen& seen) {
       return length_is_wrong(seen) && seen.request.size() > 6 && seen.ours.exception() == 3 &&
              (is_normal(seen.theirs) || seen.theirs.exception() == 2);
     }},
    {"P3", Peer::Pymodbus,
     [](const Seen& seen) {
       return single_coil_value_is_wrong(seen) && (is_normal(seen.theirs) || seen.theirs.exception() == 2);
     }},
    {"P4", Peer::Pymodbus,
     [](const Seen& seen) { return is_of_pymodbus_only(seen.request[0]) && seen.ours.exception() == 1; }},
    {"P5", Peer::Pymodbus,
     [](const Seen& seen) {
       return seen.request[0] == 43 && seen.request.size() > 1 && seen.request[1] != kIdentification &&
              seen.ours.exception() == 1;
     }},
    {"P6", Peer::Pymodbus,
     [](const Seen& seen) {
       return seen.request[0] == 43 && seen.ours.exception() == 2 && is_normal(seen.theirs);
     }},
    {"P9", Peer::Pymodbus,
     [](const Seen& seen) {
       if (seen.request.size() != 4) return false;
       const Bytes nothing{43, kIdentification, seen.request[2], 0x83, 0, 0, 0};
       return seen.request[0] == 43 && is_normal(seen.ours) && seen.theirs.pdu == nothing;
     }},
    {"P7", Peer::Pymodbus, same_but_for_conformity},
    {"P8", Peer::Pymodbus,
     [](const Seen& seen) {
       return seen.request[0] == 43 && seen.request.size() == 4 && seen.request[2] == 0 &&
              exceptions(seen, 3, 4);
     }},
};

}  // namespace

std::span<const Difference> differences() {
  return kDifferences;
}

}  // namespace stepwright::modbus::oracle
