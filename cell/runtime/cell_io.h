#pragma once

// I/O of a cell's runtime: its simulated plant with the driver wired to it, shared memory, or nothing.
//
// Threads: the service's, but for driver and plant: from the creation of the HostRuntime on those belong to
// it (image::IoDriver, host::PlantAccess).

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cell/config/cell_config.h"
#include "plant_models/bridge/plant_driver.h"
#include "plant_models/core/plant.h"
#include "runtime/ground/result/result.h"
#include "runtime/host/plant_access.h"
#include "runtime/image/io_driver.h"
#include "runtime/io_memory/memory_driver.h"

namespace stepwright::cell_runtime {

class CellIo {
 public:
  virtual ~CellIo() = default;
  virtual image::IoDriver& driver() = 0;
  // Null without a simulated plant.
  virtual host::PlantAccess* plant() = 0;
  // A guard process watches the outputs.
  virtual bool guarded() const { return false; }
  // The guard that is there.
  virtual io_memory::GuardFigures guard() const { return {}; }
  // A runtime other than this one drives the outputs.
  virtual std::optional<io_memory::ProcessMark> other_runtime() const { return std::nullopt; }
  // True if the process behind the I/O is there. Always true where it cannot be missing.
  virtual bool alive() const { return true; }
  // What has become of a plant in a process of its own, which is ended then, or of one whose equations could
  // not be solved any more; empty while all is well.
  virtual std::string trouble() { return {}; }

  // Fails with what is wrong in [plant], its ports and its scheduled faults (C0301 to C0331), and with why
  // a plant in a process of its own does not run (R0151 to R0155).
  [[nodiscard]] static result::Result<std::unique_ptr<CellIo>> create(const config::CellConfig& config);
};

// The wires of the cell's plant: its own, or those that its kind has by default.
std::vector<bridge::PortWire> plant_wires(const config::CellConfig& config);

// The cell's simulated plant as it is at the beginning, beside whatever runs: for trials. Its process runs
// where it has one. Fails with what is wrong in [plant] (C0301 to C0331, R0151 to R0155); C0448: the cell has
// none.
[[nodiscard]] result::Result<std::unique_ptr<core::Plant>> fresh_plant(const config::CellConfig& config);

// Everything that create() would refuse, found without leaving a trace: nothing is opened or kept.
result::Diagnostics check_cell_io(const config::CellConfig& config);

}  // namespace stepwright::cell_runtime
