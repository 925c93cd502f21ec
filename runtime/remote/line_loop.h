#pragma once

// The line's thread: takes commands between two turns, lets the controller scan turn by turn in simulated
// time, exchanges inputs and outputs by the wall's clock in real time, and publishes events, figures and the
// image. What a scan thread is to a runtime on the host this is to a controller behind a line.
//
// Threads: `run` is the body of the line's thread; `quit` may be called from any. Invariants: in any state
// but Running the plant has safe outputs: the controller's, or while it is not heard those of the cell's
// matrix; in simulated time the controller gets no turn unless the state is Running and no barrier holds; a
// controller that was lost while it ran is stopped when it is found again.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/host/clock_gate.h"
#include "runtime/host/event_count.h"
#include "runtime/host/real_time.h"
#include "runtime/host/snapshot_memory.h"
#include "runtime/remote/controller_link.h"
#include "runtime/remote/line_queues.h"
#include "runtime/remote/plant_feed.h"
#include "runtime/remote/remote_config.h"
#include "runtime/scan/histogram.h"

namespace stepwright::remote {

class LineLoop {
 public:
  // References must outlive the loop; `plant` may be null.
  LineLoop(const RemoteConfig& config, RegisterLine& line, image::IoDriver& driver, host::PlantAccess* plant,
           host::SnapshotWriter& snapshots, LineQueues& queues);

  // Until `quit`; then the controller is stopped, if it can be reached.
  void run();
  void quit();

 private:
  using Done = result::Result<void>;

  // Finding the controller and losing it (line_loop_contact.cpp).
  void seek();
  [[nodiscard]] Done meet();
  [[nodiscard]] Done know_program(const ControllerStatus& status);
  [[nodiscard]] Done check_identity(const ControllerStatus& status);
  void lose(const result::Diagnostics& why);

  // Commands (line_loop_commands.cpp).
  void take_commands();
  void take_urgent();
  void perform(const RemoteCommand& command);
  host::Completion apply(const RemoteCommand& command);
  host::Completion reach(const RemoteCommand& command);
  host::Completion load(const RemoteCommand& command);
  [[nodiscard]] Done bring(const RemoteProgram& program);
  [[nodiscard]] Done transfer(const RemoteProgram& program);
  [[nodiscard]] Done fits(const RemoteProgram& program);
  [[nodiscard]] Done adopt(std::shared_ptr<const RemoteProgram> program);
  host::Completion start(const host::Command& command);
  [[nodiscard]] Done begin_run();
  host::Completion stop(const host::Command& command, std::string_view reason,
                        scan::SafeCause cause = scan::SafeCause::Stop);
  host::Completion bits(const host::Command& command);
  void end_forces();
  host::Completion step(const host::Command& command);
  host::Completion inject(const host::Command& command);
  host::Completion supervisor_lost(const host::Command& command);
  host::Completion failed(std::uint64_t ticket, result::Diagnostics why);
  host::Completion lost(std::uint64_t ticket, result::Diagnostics why);
  host::Completion refused(std::uint64_t ticket, const CommandAnswer& answer);
  result::Diagnostics refusal(const CommandAnswer& answer) const;

  // Turns (line_loop.cpp).
  [[nodiscard]] Done turn_lock_step();
  [[nodiscard]] Done turn_by_clock();
  [[nodiscard]] Done scan_once();
  [[nodiscard]] result::Result<ControllerOutputs> check_turn();
  [[nodiscard]] Done take_turns_event();
  [[nodiscard]] Done exchange_by_clock();
  [[nodiscard]] Done plant_lost();
  [[nodiscard]] Done look_at_status();
  void accept(const ControllerOutputs& outputs);
  void wait(std::int64_t timeout_ns);
  std::uint16_t next_turn() { return turn_ = static_cast<std::uint16_t>(turn_ == 0xFFFF ? 1 : turn_ + 1); }

  // News (line_loop_news.cpp).
  [[nodiscard]] Done take_events(const ControllerStatus& status);
  [[nodiscard]] Done read_event_image();
  void emit(host::EventKind kind, std::string detail, scan::SafeCause cause = scan::SafeCause::Stop);
  std::string trap_detail(const ControllerStatus& status) const;
  host::ClockReading reading() { return {wall_ns(), now_.time_ns, next_ns_}; }
  [[nodiscard]] Done refresh_image();
  void publish_if_due();
  void publish();

  bool simulated() const { return config_.host.clock == host::ClockMode::Simulated; }
  bool running() const { return now_.state == host::RuntimeState::Running; }
  std::int64_t wall_ns() { return clock_.now_ns(); }
  std::int64_t own_time_ns() { return simulated() ? now_.time_ns : wall_ns() - origin_ns_; }

  const RemoteConfig& config_;
  host::SnapshotWriter& snapshots_;
  LineQueues& queues_;
  host::MonotonicClock clock_;
  std::atomic<bool> quit_{false};
  ControllerLink link_;
  PlantFeed plant_;

  std::shared_ptr<const RemoteProgram> program_;
  std::vector<std::byte> image_;  // as it was read last
  std::uint64_t image_scan_ = 0;  // after this scan
  host::RuntimeStatus now_;
  host::EventCount events_;
  image::ForceTable forces_;  // of program_; ends by the clock on the wall
  std::string detail_;        // of the newest event that has one
  std::string line_problem_;
  bool contact_ = false;
  bool met_ = false;  // ever
  std::int64_t sought_ns_ = 0;
  std::uint64_t losses_ = 0;

  std::uint16_t turn_ = 0;         // the newest
  std::uint32_t known_event_ = 0;  // of the controller
  std::uint32_t uptime_ms_ = 0;
  std::int64_t base_ns_ = 0;  // own time = the controller's + base
  std::int64_t next_ns_ = 0;  // own time of the next scan
  host::ClockGate gate_;
  std::uint64_t stopped_at_ = 0;  // order of the newest stop: starts that were asked for before it are void
  scan::Histogram turns_;         // how long a turn takes, there and back

  std::int64_t origin_ns_ = 0;      // wall at own time 0
  std::int64_t due_ns_ = 0;         // wall: of the next exchange
  std::int64_t status_due_ns_ = 0;  // wall
  std::int64_t image_due_ns_ = 0;   // wall
  std::int64_t published_ns_ = 0;   // wall
  std::int64_t progress_ns_ = 0;    // wall: when the scan number was seen to change
};

}  // namespace stepwright::remote
