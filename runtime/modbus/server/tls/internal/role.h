#pragma once

// The role in a client's certificate: extension 1.3.6.1.4.1.50316.802.1, a UTF8String (MB-TCP-Security v2.1,
// role-based client authorization). Any thread.

#include <optional>
#include <string>

#include "runtime/modbus/server/tls/internal/native.h"

namespace stepwright::modbus::server {

inline constexpr const char* kRoleOid = "1.3.6.1.4.1.50316.802.1";
inline constexpr int kMostRoleBytes = 64;

// "" for a certificate without a role. None where the extension is there but is no role: it stands there
// twice, is no UTF8String, is empty, longer than kMostRoleBytes, or holds anything but printing ASCII. Such a
// client is not let in.
std::optional<std::string> role_of(const X509* certificate);

}  // namespace stepwright::modbus::server
