#include "runtime/dds/internal/addresses.h"

#include "runtime/ground/network/own_addresses.h"

namespace stepwright::dds::internal {
namespace {

// Fast DDS is used over IPv4.
std::optional<network::IpAddress> address_of(const std::string& text) {
  return text.find(':') == std::string::npos ? network::parse_ip(text) : std::nullopt;
}

}  // namespace

result::Result<void> check_addresses(const ParticipantConfig& config) {
  for (const auto* list : {&config.interfaces, &config.peers}) {
    for (const std::string& text : *list) {
      if (!address_of(text)) return result::fail("D0004", {}, "'" + text + "' is no IPv4 address");
    }
  }
  if (config.interfaces.empty()) return result::fail("D0004", {}, "Fast DDS has no interface to use");
  const auto own = network::own_addresses();
  for (const std::string& text : config.interfaces) {
    if (network::is_own(*address_of(text), own)) continue;
    return result::fail("D0006", {}, "no interface of this machine has the address " + text,
                        "[dds] interfaces takes some of: " + network::list_of(own, true));
  }
  return {};
}

}  // namespace stepwright::dds::internal
