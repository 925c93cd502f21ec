#pragma once

// SHA-256 of a container: the name under which a program travels.

#include <cstddef>
#include <span>
#include <string>

#include "runtime/service/requests.h"

namespace stepwright::service {

Sha256 sha256(std::span<const std::byte> bytes);
// 64 lower-case hexadecimal digits.
std::string to_hex(const Sha256& digest);

}  // namespace stepwright::service
