#pragma once

// The faults of a cell's file on their way into its simulated plant, each at its time.
//
// Threads: the one that scans. No heap but at the beginning.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "runtime/host/host_config.h"
#include "runtime/host/plant_access.h"

namespace stepwright::host {

class FaultSchedule {
 public:
  explicit FaultSchedule(std::vector<ScheduledFault> faults) : faults_(std::move(faults)) {
    std::ranges::stable_sort(faults_, {}, &ScheduledFault::at_ns);
  }

  // All up to `time_ns` that were not injected before; without a plant they pass.
  void inject_due(std::int64_t time_ns, PlantAccess* plant) {
    for (; next_ < faults_.size() && faults_[next_].at_ns <= time_ns; ++next_) {
      if (plant == nullptr) continue;
      // What the plant refuses was refused when the configuration was read, too.
      static_cast<void>(plant->inject_fault(faults_[next_].name, faults_[next_].value));
    }
  }

 private:
  std::vector<ScheduledFault> faults_;
  std::size_t next_ = 0;
};

}  // namespace stepwright::host
