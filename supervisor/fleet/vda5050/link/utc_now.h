#pragma once

// The time that messages of VDA 5050 carry: UTC, in whole milliseconds.

#include <chrono>

#include "supervisor/fleet/vda5050/header.h"

namespace stepwright::vda5050_link {

inline fleet::vda5050::Timestamp utc_now() {
  return std::chrono::time_point_cast<std::chrono::milliseconds>(std::chrono::system_clock::now());
}

}  // namespace stepwright::vda5050_link
