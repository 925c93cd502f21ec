#include "cell/check/check_ports.h"

#include <string>
#include <string_view>
#include <vector>

#include "cell/check/listening_servers.h"

namespace stepwright::check {
namespace {

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

}  // namespace

result::Diagnostics check_ports(const config::CellConfig& config) {
  result::Diagnostics problems;
  const std::vector<ListeningServer> servers = listening_servers(config);
  for (std::size_t i = 0; i < servers.size(); ++i) {
    for (std::size_t before = 0; before < i; ++before) {
      if (!collide(servers[before], servers[i])) continue;
      problems.push_back({"C0473", result::Severity::Error, where_of(config, servers[i].table, "port"),
                          "port " + std::to_string(servers[i].port) + " is that of [" +
                              servers[before].table + "], too: one of them would not start",
                          "a port of its own for [" + servers[i].table + "]"});
      break;
    }
  }
  return problems;
}

}  // namespace stepwright::check
