#include "runtime/dds/internal/addresses.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <memory>

namespace stepwright::dds::internal {
namespace {

std::vector<std::string> own_addresses() {
  std::vector<std::string> addresses;
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return addresses;
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(list, &freeifaddrs);
  for (const ifaddrs* entry = list; entry != nullptr; entry = entry->ifa_next) {
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;
    std::array<char, INET_ADDRSTRLEN> text{};
    const auto* address = reinterpret_cast<const sockaddr_in*>(entry->ifa_addr);
    inet_ntop(AF_INET, &address->sin_addr, text.data(), text.size());
    addresses.emplace_back(text.data());
  }
  return addresses;
}

bool is_address(const std::string& text) {
  in_addr parsed{};
  return inet_pton(AF_INET, text.c_str(), &parsed) == 1;
}

}  // namespace

result::Result<void> check_addresses(const ParticipantConfig& config) {
  for (const auto* list : {&config.interfaces, &config.peers}) {
    for (const std::string& text : *list) {
      if (!is_address(text)) return result::fail("D0004", {}, "'" + text + "' is no IPv4 address");
    }
  }
  if (config.interfaces.empty()) return result::fail("D0004", {}, "Fast DDS has no interface to use");
  const std::vector<std::string> own = own_addresses();
  for (const std::string& text : config.interfaces) {
    // All of 127.0.0.0/8 is this machine.
    if (text.starts_with("127.") || std::find(own.begin(), own.end(), text) != own.end()) continue;
    std::string known;
    for (const std::string& each : own) known += (known.empty() ? "" : ", ") + each;
    return result::fail("D0006", {}, "no interface of this machine has the address " + text,
                        "[dds] interfaces takes some of: " + known);
  }
  return {};
}

}  // namespace stepwright::dds::internal
