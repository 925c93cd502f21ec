#pragma once

// A runtime in the caller's own process and thread: the real scan, engine and plant without the processes
// around them, in simulated time. A call of wait_event scans until the step bits change. For campaigns,
// trials of bindings and tests; it knows no planner.
//
//   SimulatedController controller(std::move(plant), wires, {64, 64}, faults);
//   auto record = planner->mission(controller, {})->run();
//   controller.plant_value("level_a1_percent");
//
// Threads: one at a time. A run that does not come to an end throws std::runtime_error.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "plant_models/bridge/plant_driver.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/host/change_plan.h"
#include "runtime/scan/scan_cycle.h"
#include "supervisor/run/controller.h"

namespace stepwright::simulation {

// A fault of the plant, injected when its time has come.
struct PlantFault {
  double at_s = 0.0;
  std::string name;
  double value = 0.0;
  bool clears = false;  // it ends instead
};

class SimulatedController : public run::Controller {
 public:
  // Any plant; its terminals as wired, areas of these sizes.
  SimulatedController(std::unique_ptr<core::Plant> plant, const std::vector<bridge::PortWire>& wires,
                      bridge::AreaSizes sizes, std::vector<PlantFault> faults = {},
                      host::HostConfig config = interpreted());
  ~SimulatedController() override;

  double plant_value(const std::string& name) const;
  const core::Plant& plant() const { return *plant_; }
  double now_s() const { return static_cast<double>(plant_->now().count()) * 1e-9; }
  // Why the plant cannot go on; empty while it can.
  std::string plant_trouble() { return plant_->trouble(); }
  bool any_output() const;
  bool running() const;
  // Of the program that is loaded. Requires one.
  std::span<const std::byte> image() const;
  // Of the program that is loaded; null without one.
  const reader::ProgramInfo* program_info() const;
  std::uint64_t programs_loaded() const { return programs_loaded_; }
  // Runs one scan of a program that runs, with the faults whose time has come; false when it no longer does.
  // Of steps that change only wait_event() tells.
  bool scan_once();
  // The next call finds the runtime gone; a new one, empty, is there after that. The plant stays.
  void kill_runtime() { killed_ = true; }
  // The same, before the first scan after this time of the plant.
  void kill_runtime_at(double time_s) { kill_at_s_ = time_s; }
  // Nobody hears of it, as on a busy machine; whoever waits for it finds it as it was.
  void silence_runtime() { silent_ = true; }
  void refuse_changes() { refuse_changes_ = true; }
  int changes() const { return changes_; }
  std::function<void(std::span<const std::byte> outputs)> on_change;  // as they are after the swap
  std::function<void(std::span<const std::byte> image)> on_scan;      // after every scan
  // A fault that the plant does not take as it stands, and why; without a function it is thrown.
  std::function<void(const PlantFault&, const std::string& why)> on_refused;
  // A run that goes on longer, in plant time, is thrown as one that hangs.
  double most_s = std::numeric_limits<double>::infinity();
  int stops() const { return stops_; }
  // The call of wait_event that scans, or the next one, ends without an event: for a plant that rests.
  void interrupt() { interrupted_ = true; }

  bool wait_for_runtime(std::chrono::milliseconds) override;
  bool alive() const override { return !killed_ && !silent_; }
  result::Result<std::string> download(std::span<const std::byte> container) override;
  result::Result<std::string> change(std::span<const std::byte> container) override;
  result::Result<void> start(bool barrier) override;
  result::Result<void> stop(const std::string& reason) override;
  result::Result<void> acknowledge(std::uint64_t event_sequence) override;
  result::Result<std::vector<std::byte>> program() override;
  std::optional<host::StepEvent> wait_event(std::chrono::milliseconds timeout) override;
  std::optional<host::RuntimeStatus> status() const override;
  std::optional<host::Snapshot> snapshot() const override;

 private:
  struct Loaded;  // a program with its memory
  void push_event(host::EventKind kind, std::string detail);
  void inject_due();
  void tell_steps();
  static host::HostConfig interpreted();
  result::Result<std::unique_ptr<host::PreparedProgram>> prepare(std::span<const std::byte> container);

  std::unique_ptr<core::Plant> plant_;
  std::optional<bridge::PlantDriver> driver_;
  std::optional<host::AreaDriver> areas_;
  host::HostConfig config_;
  std::unique_ptr<scan::Clock> clock_;
  std::unique_ptr<Loaded> loaded_;
  std::vector<PlantFault> faults_;  // not yet injected, in order of time
  std::deque<host::StepEvent> events_;
  std::uint64_t sequence_ = 0;
  std::uint64_t acknowledged_ = 0;
  scan::StartPoint next_start_;
  std::uint64_t programs_loaded_ = 0;
  bool killed_ = false;
  bool silent_ = false;
  std::optional<double> kill_at_s_;
  bool refuse_changes_ = false;
  bool interrupted_ = false;
  int changes_ = 0;
  int stops_ = 0;
};

}  // namespace stepwright::simulation
