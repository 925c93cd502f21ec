#pragma once

// A runtime that scans every millisecond, its service, and the Modbus server on it: what `stepwright runtime`
// and `stepwright modbus-server` are, in one process.

#include <chrono>
#include <cstdint>
#include <memory>

#include "runtime/host/messages.h"

namespace stepwright::bench {

class RuntimeServer {
 public:
  RuntimeServer();
  ~RuntimeServer();
  std::uint16_t port() const;
  // The program is loaded and started anew, so that its figures begin again.
  void restart();
  host::TaskStatus task() const;  // of the only one
  double service_p99_us() const;  // within the server; call it when nobody is served

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace stepwright::bench
