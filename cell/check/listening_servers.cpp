#include "cell/check/listening_servers.h"

#include "runtime/ground/settings/toml_document.h"

namespace stepwright::check {
namespace {

void add_figures(std::vector<ListeningServer>& servers, const char* table,
                 const config::MetricsConfig& metrics) {
  if (metrics.port) servers.push_back({table, "host", metrics.host, *metrics.port});
}

}  // namespace

std::vector<ListeningServer> listening_servers(const config::CellConfig& config) {
  std::vector<ListeningServer> servers = {{"hmi", "host", config.hmi.host, config.hmi.port}};
  if (config.modbus_server.enabled) {
    const config::ModbusAcceptors& acceptors = config.modbus_server.acceptors;
    if (acceptors.plain)
      servers.push_back(
          {"modbus.server", "bind", config.modbus_server.tcp.bind, config.modbus_server.tcp.port});
    if (acceptors.tls)
      servers.push_back({"modbus.server.tls", "bind", acceptors.tls->tcp.bind, acceptors.tls->tcp.port});
    add_figures(servers, "modbus.server.metrics", config.modbus_server.metrics);
  }
  add_figures(servers, "modbus.client.metrics", config.modbus_client_metrics);
  if (config.controller.remote()) add_figures(servers, "controller.metrics", config.controller.metrics);
  return servers;
}

result::Location where_of(const config::CellConfig& config, std::string_view table, std::string_view key) {
  auto document = settings::TomlDocument::load(config.file);
  if (!document) return {config.file.string(), 0, 0};
  settings::TomlTable found = (*document)->root();
  while (!table.empty()) {
    const std::size_t dot = table.find('.');
    found = found.table(table.substr(0, dot));
    table = dot == std::string_view::npos ? std::string_view() : table.substr(dot + 1);
  }
  return found.where(key);
}

}  // namespace stepwright::check
