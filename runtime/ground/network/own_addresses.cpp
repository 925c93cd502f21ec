#include "runtime/ground/network/own_addresses.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

namespace stepwright::network {
namespace {

std::optional<IpAddress> address_of(const sockaddr* address) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (address == nullptr) return std::nullopt;
  if (address->sa_family == AF_INET) {
    inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(address)->sin_addr, text.data(), text.size());
  } else if (address->sa_family == AF_INET6) {
    inet_ntop(AF_INET6, &reinterpret_cast<const sockaddr_in6*>(address)->sin6_addr, text.data(), text.size());
  }
  return parse_ip(text.data());
}

bool is_in(const char* range, const IpAddress& address) {
  return IpRange::parse(range)->contains(address);
}

}  // namespace

std::vector<IpAddress> own_addresses() {
  std::vector<IpAddress> addresses;
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return addresses;
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(list, &freeifaddrs);
  for (const ifaddrs* entry = list; entry != nullptr; entry = entry->ifa_next)
    if (const auto address = address_of(entry->ifa_addr)) addresses.push_back(*address);
  return addresses;
}

bool is_own(const IpAddress& address, const std::vector<IpAddress>& own) {
  for (const char* each : {"127.0.0.0/8", "::1", "0.0.0.0", "::"})
    if (is_in(each, address)) return true;
  return std::ranges::find(own, address) != own.end();
}

std::string list_of(const std::vector<IpAddress>& addresses, bool v4) {
  std::string list;
  for (const IpAddress& each : addresses) {
    const std::string text = to_string(each);
    if (v4 && text.find(':') != std::string::npos) continue;
    list += (list.empty() ? "" : ", ") + text;
  }
  return list;
}

}  // namespace stepwright::network
