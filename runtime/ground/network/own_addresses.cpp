#include "runtime/ground/network/own_addresses.h"

#include <ifaddrs.h>
#include <netinet/in.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>

namespace stepwright::network {
namespace {

constexpr std::size_t kMappedBytes = 12;

std::optional<IpAddress> address_of(const sockaddr* address) {
  IpAddress found{};
  if (address != nullptr && address->sa_family == AF_INET6) {
    sockaddr_in6 v6{};
    std::memcpy(&v6, address, sizeof v6);
    std::memcpy(found.data(), &v6.sin6_addr, found.size());
    return found;
  }
  if (address == nullptr || address->sa_family != AF_INET) return std::nullopt;
  sockaddr_in v4{};
  std::memcpy(&v4, address, sizeof v4);
  found[10] = found[11] = 0xFF;
  std::memcpy(found.data() + kMappedBytes, &v4.sin_addr, sizeof v4.sin_addr);
  return found;
}

bool is_in(const char* range, const IpAddress& address) {
  return IpRange::parse(range)->contains(address);
}

bool is_v4(const IpAddress& address) {
  return is_in("::ffff:0:0/96", address);
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
    if (v4 && !is_v4(each)) continue;
    list += (list.empty() ? "" : ", ") + to_string(each);
  }
  return list;
}

}  // namespace stepwright::network
