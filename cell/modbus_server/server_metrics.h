#pragma once

// Metrics of the Modbus server for Prometheus, and the newest status of its thread for others. Threads: any.
//
//   LatestStatus latest;
//   latest.publish({server.figures(), data.serving(), expires});              // the server's thread
//   const std::string text = server_metrics("bench", latest.newest());       // any other

#include <chrono>
#include <mutex>
#include <optional>
#include <string>

#include "runtime/modbus/server/options.h"

namespace stepwright::modbus_server {

struct ServerStatus {
  modbus::server::ServerFigures figures;
  bool serving = false;  // the runtime's values can be read
  // Of the certificate; none without TLS.
  std::optional<std::chrono::system_clock::time_point> certificate_ends;
};

// The newest status of a thread that others ask about.
class LatestStatus {
 public:
  void publish(const ServerStatus& status) {
    const std::lock_guard lock(mutex_);
    newest_ = status;
  }
  ServerStatus newest() const {
    const std::lock_guard lock(mutex_);
    return newest_;
  }

 private:
  mutable std::mutex mutex_;
  ServerStatus newest_;
};

// Text exposition format 0.0.4; every sample has the label `cell`. runtime/doc/modbus.md lists the figures.
std::string server_metrics(const std::string& cell, const ServerStatus& status);

}  // namespace stepwright::modbus_server
