#pragma once

// A runtime: loads containers, runs them in its scan thread, keeps its state machine, and reports.
//
//   HostConfig config;                                           // simulated clock, as fast as possible
//   auto runtime = HostRuntime::create(config, driver, &plant);
//   (*runtime)->load(1, container, digest);                      // prepared beside this thread
//   (*runtime)->submit({.kind = CommandKind::Start, .barrier = true, .ticket = 2});
//   poll((*runtime)->descriptor()), then:
//   (*runtime)->clear();
//   while (auto completion = (*runtime)->take_completion()) ...
//   while (auto event = (*runtime)->take_event()) ...
//
// Threads: create, use and destroy it on one thread (the service's); it brings its own for the scan and for
// the preparation of programs. A start waits for the downloads that were asked for before it; everything else
// is performed meanwhile, on the program that is loaded. Driver
// and plant are called by the scan thread only and must outlive the runtime. States: Empty -load-> Stopped
// -start-> Running -stop, load, lost supervisor-> Stopped; Running -trap, lost I/O-> Fault -start-> Running;
// Fault -load-> Stopped; an online change, and its rollback, stay in Running.

#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "runtime/host/host_config.h"
#include "runtime/host/plant_access.h"
#include "runtime/host/program_preparer.h"
#include "runtime/host/program_registry.h"
#include "runtime/host/runtime_port.h"
#include "runtime/host/scan_loop.h"
#include "runtime/host/scan_monitor.h"
#include "runtime/image/io_driver.h"

namespace stepwright::host {

class HostRuntime final : public RuntimePort {
 public:
  // Starts the scan thread with nothing loaded. Fails with R0077 (system) or R0081 (a plant with too many
  // values).
  [[nodiscard]] static result::Result<std::unique_ptr<HostRuntime>> create(const HostConfig& config,
                                                                           image::IoDriver& driver,
                                                                           PlantAccess* plant);
  // As `end`; then retained values and the recording are written.
  ~HostRuntime() override;

  // Stops the program and joins the scan thread: outputs are in their safe state and the driver has
  // released them when it returns. Waits for no disk. Nothing but the status and the destructor may follow.
  void end();

  [[nodiscard]] result::Result<void> load(std::uint64_t ticket, std::vector<std::byte> container,
                                          std::string digest) override;
  [[nodiscard]] result::Result<void> change(std::uint64_t ticket, std::vector<std::byte> container,
                                            std::string digest, DownloadMode mode) override;
  [[nodiscard]] bool submit(const Command& command) override;
  [[nodiscard]] result::Result<void> write(std::uint64_t ticket, BlockWrite block) override;
  std::optional<Completion> take_completion() override;
  std::optional<StepEvent> take_event() override;
  RuntimeStatus status() const override;
  std::span<const std::byte> program() const override;
  int descriptor() const override;
  void clear() override;
  int snapshot_descriptor() const override;
  Forces forces() const override;
  std::vector<PlantFault> faults() const override;
  [[nodiscard]] result::Result<void> record(std::uint64_t ticket,
                                            const record::RecordingOptions& options) override;
  record::RecordingStatus recording() const override { return recorder_.status(); }

  // The task of the loaded program that the scan thread leads with, and how punctual a task is; whole after a
  // stop, else up to 0.1 s old. Require a loaded program.
  std::uint32_t leading_task() const { return loop_->figures().program->tasks().leader; }
  scan::TaskTiming timing(std::uint32_t task) const { return loop_->figures().program->timing(task); }
  // Downloads that are prepared at present; they go on with take_completion.
  std::size_t preparing() const { return preparer_.under_way(); }
  // The monotonic clock at scan time 0.
  std::int64_t clock_origin_ns() const { return loop_->clock_origin_ns(); }
  // Something about this process that its status should say, behind the rest. Any thread.
  void set_note(const std::string& of, std::string note);
  // Whether the scan comes back. Any thread.
  const ScanMonitor& monitor() const { return monitor_; }

 private:
  struct NewestEvent {
    EventKind kind = EventKind::Started;
    std::string program_digest;
    std::string detail;
  };

  HostRuntime(const HostConfig& config, image::IoDriver& driver, PlantAccess* plant,
              std::unique_ptr<SnapshotWriter> snapshots, std::unique_ptr<SnapshotReader> reader);

  void start_threads();
  bool send(const Command& command);
  bool pass_on(Command command);
  // On the preparer's thread.
  [[nodiscard]] result::Result<Preparation> prepare(PreparationJob job);
  void take_preparations();
  [[nodiscard]] result::Result<void> hand_over(Preparation prepared);
  void explain(const ProgramRegistry::Held& held, Completion& completion) const;
  // True while the newest event is the reason of the runtime's state.
  static bool still_holds(const NewestEvent& event, const ScanFigures& figures);
  StepEvent to_event(const PreparedProgram& program, const EventRing::Slot& slot) const;

  HostConfig config_;
  AreaDriver io_;
  const PlantAccess* plant_;
  std::span<const std::string> plant_names_;
  std::unique_ptr<SnapshotWriter> snapshots_;
  std::unique_ptr<SnapshotReader> reader_;
  std::uint64_t incarnation_;
  std::unique_ptr<record::RetainManager> retain_;
  record::Recorder recorder_;  // ends after the scan thread
  std::unique_ptr<ScanLoop> loop_;
  ScanMonitor monitor_;  // between what it looks at all the time and the programs, whose tasks come and go
  std::string refused_;  // what the system refused to the scan thread
  NewestEvent newest_;   // that the service has heard of
  std::uint64_t traps_ = 0;  // that the service has heard of
  mutable std::mutex note_mutex_;
  std::map<std::string, std::string> notes_;  // by what they are of
  ProgramRegistry programs_;
  std::map<std::uint64_t, std::unique_ptr<const BlockWrite>> blocks_;  // by ticket, while they are under way
  std::size_t commands_under_way_ = 0;
  std::uint64_t last_order_ = 0;
  std::deque<Command> starts_;             // that wait for a download
  std::deque<Completion> refusals_;        // of programs that could not be had
  std::optional<std::uint64_t> changing_;  // ticket of the change that is prepared: what runs must stay
  ProgramPreparer preparer_;               // last but one: it uses the rest
  std::thread thread_;
};

}  // namespace stepwright::host
