#include "programs/check/check_ports.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/settings/toml_document.h"

namespace stepwright::check {
namespace {

struct ListeningServer {
  std::string table;  // dotted
  std::string host;
  std::uint16_t port = 0;
};

bool is_every_address(const std::string& host) {
  return host == "0.0.0.0" || host == "::";
}

// "localhost" is the loopback address; other names are left to the start.
std::string_view address_of(const std::string& host) {
  return host == "localhost" ? std::string_view("127.0.0.1") : host;
}

bool collide(const ListeningServer& one, const ListeningServer& other) {
  if (one.port == 0 || one.port != other.port) return false;
  return is_every_address(one.host) || is_every_address(other.host) ||
         address_of(one.host) == address_of(other.host);
}

void add_figures(std::vector<ListeningServer>& servers, const char* table,
                 const config::MetricsConfig& metrics) {
  if (metrics.port) servers.push_back({table, metrics.host, *metrics.port});
}

std::vector<ListeningServer> servers_of(const config::CellConfig& config) {
  std::vector<ListeningServer> servers = {{"hmi", config.hmi.host, config.hmi.port}};
  if (config.modbus_server.enabled) {
    const config::ModbusAcceptors& acceptors = config.modbus_server.acceptors;
    if (acceptors.plain)
      servers.push_back({"modbus.server", config.modbus_server.tcp.bind, config.modbus_server.tcp.port});
    if (acceptors.tls)
      servers.push_back({"modbus.server.tls", acceptors.tls->tcp.bind, acceptors.tls->tcp.port});
    add_figures(servers, "modbus.server.metrics", config.modbus_server.metrics);
  }
  add_figures(servers, "modbus.client.metrics", config.modbus_client_metrics);
  if (config.controller.remote()) add_figures(servers, "controller.metrics", config.controller.metrics);
  return servers;
}

result::Location where_of(const config::CellConfig& config, std::string_view table) {
  auto document = settings::TomlDocument::load(config.file);
  if (!document) return {config.file.string(), 0, 0};
  settings::TomlTable found = (*document)->root();
  while (!table.empty()) {
    const std::size_t dot = table.find('.');
    found = found.table(table.substr(0, dot));
    table = dot == std::string_view::npos ? std::string_view() : table.substr(dot + 1);
  }
  return found.where("port");
}

}  // namespace

result::Diagnostics check_ports(const config::CellConfig& config) {
  result::Diagnostics problems;
  const std::vector<ListeningServer> servers = servers_of(config);
  for (std::size_t i = 0; i < servers.size(); ++i) {
    for (std::size_t before = 0; before < i; ++before) {
      if (!collide(servers[before], servers[i])) continue;
      problems.push_back({"C0473", result::Severity::Error, where_of(config, servers[i].table),
                          "port " + std::to_string(servers[i].port) + " is that of [" +
                              servers[before].table + "], too: one of them would not start",
                          "a port of its own for [" + servers[i].table + "]"});
      break;
    }
  }
  return problems;
}

}  // namespace stepwright::check
