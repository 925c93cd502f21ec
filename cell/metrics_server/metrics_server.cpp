#include "cell/metrics_server/metrics_server.h"

#include <utility>

#include "runtime/metrics/metrics_text.h"

namespace stepwright::metrics {

result::Result<std::unique_ptr<MetricsServer>> MetricsServer::start(const config::MetricsConfig& config,
                                                                    const std::string& setting,
                                                                    std::function<std::string()> text) {
  std::unique_ptr<MetricsServer> self(new MetricsServer());
  if (!config.port) return self;
  auto http = server::HttpServer::listen_for_metrics({config.host, *config.port, setting}, std::move(text),
                                                     std::string(kContentType));
  if (!http) {
    for (result::Diagnostic& each : http.error()) each.where = config.where;
    return result::forward(http);
  }
  self->http_ = std::move(*http);
  const bool v6 = config.host.find(':') != std::string::npos;
  self->address_ = "http://" + (v6 ? "[" + config.host + "]" : config.host) + ":" +
                   std::to_string(self->http_->port()) + "/metrics";
  self->thread_ = std::thread([server = self->http_.get()] { server->run(); });
  return self;
}

MetricsServer::~MetricsServer() {
  if (!thread_.joinable()) return;
  http_->stop();
  thread_.join();
}

}  // namespace stepwright::metrics
