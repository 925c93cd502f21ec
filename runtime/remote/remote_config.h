#pragma once

// Configuration of a controller behind a line. Everything about scans, safe states, faults and the supervisor
// is what a host of its own would have (runtime/host/host_config.h). Plain data; any thread.

#include <chrono>

#include "runtime/host/host_config.h"

namespace stepwright::remote {

struct RemoteConfig {
  host::HostConfig host;                          // clock: simulated = lock-step, real = the controller's own
  std::chrono::milliseconds lost_after{500};      // without an answer for this long the line is lost
  std::chrono::milliseconds exchange_period{10};  // real clock: inputs there and outputs back this often
  std::chrono::milliseconds image_period{100};    // the whole image is read this often; at events anyway
  std::chrono::milliseconds status_period{250};   // while no scans bring news
  std::chrono::milliseconds reconnect_period{200};  // between two attempts at a lost line
};

}  // namespace stepwright::remote
