#pragma once

// A process' own figures over HTTP: GET /metrics and nothing else, by the server that the page process has.
//
//   auto metrics = MetricsServer::start(config.modbus_server.metrics, "modbus.server.metrics", [&] { ... });
//   if (!metrics) return fail(metrics.error());
//
// Threads: create and destroy it on one; it has one of its own, on which `text` is called for each request.
// Invariant: bounded connections, memory and times (hmi_web/server/http_server.h); whoever scrapes costs the
// process' own loop nothing but the time of `text`.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "cell/config/metrics_config.h"
#include "hmi_web/server/http_server.h"
#include "runtime/ground/result/result.h"

namespace stepwright::metrics {

class MetricsServer {
 public:
  // Serves from now on; without a port in the configuration nothing listens. `setting` is the table that says
  // where, for hints. Fails with H0001 and H0002 as HttpServer does. What `text` uses must outlive the
  // server. Signals are to be blocked before: the thread inherits that.
  [[nodiscard]] static result::Result<std::unique_ptr<MetricsServer>> start(
      const config::MetricsConfig& config, const std::string& setting, std::function<std::string()> text);
  ~MetricsServer();
  MetricsServer(const MetricsServer&) = delete;
  MetricsServer& operator=(const MetricsServer&) = delete;

  // "http://127.0.0.1:9502/metrics"; empty: nothing listens.
  const std::string& address() const { return address_; }

 private:
  MetricsServer() = default;

  std::string address_;
  std::unique_ptr<server::HttpServer> http_;
  std::thread thread_;
};

}  // namespace stepwright::metrics
