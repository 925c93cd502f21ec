#pragma once

// Options of a Modbus server, each with a safe default, and the figures that it counts. Plain data; any
// thread.

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/modbus/server/access.h"
#include "runtime/scan/histogram.h"

namespace stepwright::modbus::server {

struct ServerOptions {
  std::size_t max_connections = 1'200;                // whoever comes then is turned away
  std::size_t max_per_address = 256;                  // of those, from one address
  std::chrono::milliseconds idle_timeout{0};          // without a request; 0: none
  std::chrono::milliseconds greeting_timeout{5'000};  // until a transport knows its peer (handshakes)
  std::chrono::milliseconds send_timeout{2'000};      // whoever reads nothing for so long is dropped
  std::vector<std::uint8_t> units;                    // that are served; empty: every unit
  bool answer_unknown_units = true;                   // with exception 11; false: not at all
  std::vector<ClientRule> clients;
  // Objects 0 to 6 of FC 43/14.
  std::array<std::string, 7> identification{"Stepwright", "soft PLC", "0"};
};

// Since the server began.
struct ServerFigures {
  std::uint64_t connections = 0;  // now
  std::uint64_t accepted = 0;
  std::uint64_t turned_away = 0;  // limits, the allow-list
  std::uint64_t dropped = 0;      // slow, idle, malformed
  std::uint64_t requests = 0;
  std::uint64_t writes = 0;
  std::array<std::uint64_t, 16> exceptions{};  // by code
  std::uint64_t malformed = 0;                 // frames that ended their connection
  scan::Histogram service_time;                // from the wake-up to the answer's being sent; reads only
};

}  // namespace stepwright::modbus::server
