#pragma once

// The acceptor of a serial line: the line is the one client behind it, from the moment that the device can be
// opened. A device that is missing or goes away is tried again every second, so that an adapter may be
// plugged in later.
//
//   server.add(LineAcceptor::create({.device = "/dev/ttyUSB0"}, [&](const auto& problems) { log ... }));
//
// Threads: that of the server.

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "runtime/modbus/server/line/serial_line.h"
#include "runtime/modbus/server/transport.h"

namespace stepwright::modbus::server {

class LineAcceptor final : public Acceptor {
 public:
  // Why the line could not be opened; told once for each reason, not every second.
  using OnTrouble = std::function<void(const result::Diagnostics&)>;

  // The first attempt is due at once.
  static std::unique_ptr<LineAcceptor> create(LineOptions options, OnTrouble on_trouble,
                                              std::chrono::milliseconds retry = std::chrono::seconds(1));
  ~LineAcceptor() override;

  int descriptor() const override;
  std::unique_ptr<Transport> admit() override;
  void turn_away() override;
  std::string name() const override;

 private:
  struct State;
  explicit LineAcceptor(std::shared_ptr<State> state);
  std::shared_ptr<State> state_;  // with the transport, which tells it that the line is free again
};

}  // namespace stepwright::modbus::server
