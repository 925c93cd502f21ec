#pragma once

// Interface to a simulated plant beside its terminals: the true state for reports, and faults to inject.
//
// Threads: the scan thread; the names are constant. Reading values allocates nothing.

#include <span>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "runtime/host/plant_fault.h"

namespace stepwright::host {

class PlantAccess {
 public:
  virtual ~PlantAccess() = default;

  // Names of the values, with their units; constant. At most kMaxPlantValues of at most kMaxNameBytes.
  virtual std::span<const std::string> value_names() const = 0;
  // Scan thread; no heap, lock or log. Requires as many places as names.
  virtual void read_values(std::span<double> values) const = 0;
  // All that it can have, in an order that stays, with what holds now. Any thread.
  virtual std::vector<PlantFault> faults() const { return {}; }
  // Scan thread, between two scans; a fault is set up, not simulated, so it may allocate.
  // A value that is not a number ends the fault.
  [[nodiscard]] virtual result::Result<void> inject_fault(const std::string& name, double value) = 0;
};

}  // namespace stepwright::host
