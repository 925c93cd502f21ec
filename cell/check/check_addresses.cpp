#include "cell/check/check_addresses.h"

#include <string>
#include <string_view>

#include "cell/check/listening_servers.h"
#include "runtime/ground/network/own_addresses.h"

namespace stepwright::check {

result::Diagnostics check_addresses(const config::CellConfig& config) {
  result::Diagnostics problems;
  const auto own = network::own_addresses();
  if (own.empty()) return problems;
  // Names are left to the start.
  const auto check = [&](std::string_view table, std::string_view key, const std::string& text, bool v4) {
    const auto address = network::parse_ip(text);
    if (!address || network::is_own(*address, own)) return;
    problems.push_back({"C0474", result::Severity::Warning, where_of(config, table, key),
                        "no interface of this machine has the address " + text +
                            ": nothing of this cell can listen there on this machine",
                        "here it is one of: " + network::list_of(own, v4)});
  };
  for (const ListeningServer& server : listening_servers(config))
    check(server.table, server.host_key, server.host, false);
  for (const std::string& each : config.dds.interfaces) check("dds", "interfaces", each, true);
  return problems;
}

}  // namespace stepwright::check
