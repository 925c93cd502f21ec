#pragma once

// The addresses of this machine, for settings that name some of them. Threads: any.

#include <string>
#include <vector>

#include "runtime/ground/network/ip_range.h"

namespace stepwright::network {

// Those of its interfaces now, IPv4 and IPv6. Empty: the system does not say.
std::vector<IpAddress> own_addresses();

// Whether something on a machine with these addresses can listen at `address`: one of them, one of loopback
// (127.0.0.0/8, ::1), or every address (0.0.0.0, ::).
bool is_own(const IpAddress& address, const std::vector<IpAddress>& own);

// As people write them, with commas between; the IPv4 ones alone if `v4`.
std::string list_of(const std::vector<IpAddress>& addresses, bool v4);

}  // namespace stepwright::network
