#pragma once

// The plant's side of a controller's turn: inputs from the plant, outputs to it, faults when their time has
// come; and outputs in their safe state when the controller cannot be heard. Outputs of the cell that the
// controller's program lacks are in their safe state all the time.
//
// Threads: the line's. Driver and plant must outlive it. Times are the gateway's scan clock in ns.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/host/area_driver.h"
#include "runtime/host/fault_schedule.h"
#include "runtime/host/host_config.h"
#include "runtime/host/messages.h"
#include "runtime/host/plant_access.h"
#include "runtime/scan/safe_state.h"

namespace stepwright::remote {

class PlantFeed {
 public:
  // `plant` may be null: then there is nothing to inject and no truth. The configuration must outlive it.
  PlantFeed(const host::HostConfig& config, image::IoDriver& driver, host::PlantAccess* plant);

  // Makes room for the areas of a program at `time_ns`: outputs that it lacks are as after a stop. Requires
  // areas no larger than the cell's.
  void fit(std::size_t input_bytes, std::size_t output_bytes, std::int64_t time_ns);

  // Reads the plant's inputs at `time_ns`; false if it does not answer, or this process stood still.
  bool read(std::int64_t time_ns);
  std::span<const std::byte> inputs() const { return inputs_; }

  // Where the outputs of the controller are to be put, and then written.
  std::span<std::byte> outputs() { return outputs_; }
  bool write(std::int64_t time_ns);

  // From now on safe outputs, of the cell's matrix, until the next `write`: of `killed` if this process stood
  // still, else of lost I/O.
  void make_safe(std::int64_t time_ns);
  // Ramps go on.
  void keep_safe(std::int64_t time_ns);

  // This process stood still and others took it for lost: the reason why read or write failed.
  bool stood_still() const { return stood_still_; }
  // The end of driving.
  void release_outputs() { io_.release_outputs(); }
  // This side is alive, for whoever looks at the outputs' other end.
  void beat() { io_.beat(); }

  // Scheduled faults up to `time_ns`.
  void inject_due(std::int64_t time_ns) { faults_.inject_due(time_ns, plant_); }
  host::PlantAccess* plant() const { return plant_; }
  std::span<const double> truths();
  std::vector<host::NamedValue> named_truths();

 private:
  host::AreaDriver io_;
  host::PlantAccess* plant_;
  std::vector<std::byte> inputs_;
  std::vector<std::byte> outputs_;
  std::vector<std::byte> safe_memory_;
  scan::SafeState safe_;
  bool stood_still_ = false;  // until outputs of the controller are written again
  host::FaultSchedule faults_;
  std::vector<double> truths_;
};

}  // namespace stepwright::remote
