#pragma once

// Health of a runtime as supervisor and HMI see it, and how its news arrive here. Plain data; any thread.

#include <cstdint>
#include <string>

#include "runtime/service/health.h"

namespace stepwright::dds {

using host::DurationCounts;
using host::TaskDetail;
using service::DeviceHealth;
using service::IoKind;
using service::RuntimeHealth;

// One topic as this process receives it.
struct TopicTraffic {
  std::string topic;
  std::uint32_t writers = 0;   // that are matched now
  std::uint64_t received = 0;  // samples
  std::uint64_t refused = 0;   // of these, the ones that broke a bound
  std::uint64_t lost = 0;      // that were sent and never came
  double age_s = -1.0;         // of the newest; -1: none has come
};

}  // namespace stepwright::dds
