#pragma once

// Messages of a runtime: the values that travel over the service socket and, unchanged in meaning, over Fast
// DDS. Plain data without behaviour; any thread.
//
// Addresses are byte offsets into the process image, whose layout the container describes; a bit of a located
// BOOL is a one-bit mask. Times are the runtime's scan clock: nanoseconds since the process started it.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/host/runtime_state.h"
#include "runtime/image/force_table.h"
#include "runtime/image/image_bits.h"
#include "runtime/scan/safe_state.h"

namespace stepwright::host {

struct NamedValue {
  std::string name;  // as the plant names it, with its unit: "level_a1_percent"
  double value = 0.0;

  friend bool operator==(const NamedValue&, const NamedValue&) = default;
};

// Something happened between two scans. Sequence numbers count from 1 over the life of one runtime process.
struct StepEvent {
  std::uint64_t sequence = 0;
  std::uint64_t scan = 0;    // the scan after which it happened; counts over program changes
  std::int64_t time_ns = 0;  // scan clock of that scan
  EventKind kind = EventKind::StepChange;
  std::string program_digest;     // hexadecimal SHA-256 of the container
  std::string detail;             // why it stopped or trapped; empty for a step change
  std::vector<std::byte> image;   // the complete image after that scan
  std::vector<NamedValue> plant;  // truth of the simulated plant at that instant, for reports only
  std::uint64_t incarnation = 0;  // of the process it is of; filled in by the service
  scan::SafeCause cause = scan::SafeCause::Stop;  // of Stopped and Trap: why nobody drives the outputs

  friend bool operator==(const StepEvent&, const StepEvent&) = default;
};

// A distribution of durations; percentiles are right to 1/32, the maximum is exact.
struct DurationSpread {
  double p50_us = 0.0;
  double p99_us = 0.0;
  double p999_us = 0.0;
  double p9999_us = 0.0;
  double max_us = 0.0;

  friend bool operator==(const DurationSpread&, const DurationSpread&) = default;
};

// How punctual a task is since its program was loaded (scan::TaskTiming says what is counted). Latency and
// jitter stay 0 in simulated time.
struct TaskStatus {
  std::string name;
  std::uint32_t interval_us = 0;  // 0: an event, or freewheeling
  std::uint32_t priority = 0;     // 0 is the highest
  std::uint64_t cycles = 0;
  std::uint64_t overruns = 0;
  std::uint64_t skipped = 0;
  DurationSpread latency;    // from the instant at which it was due to its beginning
  DurationSpread execution;  // from its beginning to its end
  DurationSpread jitter;     // of its period, from its interval

  friend bool operator==(const TaskStatus&, const TaskStatus&) = default;
};

// A distribution to be drawn: how many durations lie in each bucket, two buckets for a doubling
// (duration_counts.h says where they end).
struct DurationCounts {
  std::uint32_t first = 0;            // number of the first bucket that holds any
  std::vector<std::uint64_t> counts;  // from it to the last one that holds any; at most kMaxDurationCounts

  friend bool operator==(const DurationCounts&, const DurationCounts&) = default;
};

// Details of a task, asked for separately; in the order of the tasks.
struct TaskDetail {
  std::string name;
  std::uint64_t watchdog_us = 0;  // 0: none
  std::uint32_t watchdog_sensitivity = 0;
  std::uint32_t too_long = 0;  // executions in a row that exceeded the watchdog's time
  std::uint32_t watchdog_expiries = 0;
  DurationCounts latency;
  DurationCounts execution;
  DurationCounts jitter;

  friend bool operator==(const TaskDetail&, const TaskDetail&) = default;
};

// Figures of the runtime's process, for monitoring.
struct ProcessFigures {
  std::string version;               // of Stepwright
  double uptime_s = 0.0;             // since the service began
  std::uint64_t resident_bytes = 0;  // of memory, at most a second old
  std::uint64_t clients = 0;         // of the service: a link, tools
  std::uint64_t traps = 0;           // program faults and lost I/O since the process began
  std::uint64_t lost_events = 0;     // that the service did not take in time (real clock only)
  std::uint64_t warnings = 0;  // conditions that somebody should mend; `detail` of the status names them

  friend bool operator==(const ProcessFigures&, const ProcessFigures&) = default;
};

struct RuntimeStatus {
  std::uint64_t incarnation =
      0;  // differs from one runtime process to the next; sequences start again with it
  RuntimeState state = RuntimeState::Empty;
  std::string program_digest;  // empty without a program
  std::uint64_t scan = 0;
  std::int64_t time_ns = 0;
  std::uint64_t last_event = 0;  // sequence of the newest event, 0 = none yet
  std::uint64_t overruns = 0;    // scans that began later than their period allows (real clock only)
  double scan_p50_us = 0.0;      // duration of a scan, without the wait for the next; right to 1/32
  double scan_p99_us = 0.0;
  double scan_max_us = 0.0;
  double realtime_factor = 0.0;          // scan-clock seconds per second of computing; barriers do not count
  std::uint64_t trace_hash = 0;          // over every scan so far, chained over program changes
  bool waiting_for_supervisor = false;   // standing still at a barrier until last_event is acknowledged
  std::string detail;                    // why it is in this state; what it could not get from the system
  std::vector<NamedValue> plant;         // truth of the simulated plant, for reports
  std::vector<TaskStatus> tasks;         // in the order of the program; at most bytecode::kMaxTasks
  std::vector<TaskDetail> task_details;  // of the same tasks; over Fast DDS they travel apart from the rest
  ProcessFigures process;
  std::uint64_t changes = 0;          // online changes so far, those that were rolled back included
  double last_change_pause_us = 0.0;  // by which the newest one made the scan thread later

  friend bool operator==(const RuntimeStatus&, const RuntimeStatus&) = default;
};

// The image between two scans, consistent in itself.
struct Snapshot {
  std::uint64_t scan = 0;
  std::int64_t time_ns = 0;
  std::string program_digest;
  std::vector<std::byte> image;
  std::vector<NamedValue> plant;
  std::uint64_t incarnation = 0;  // of the process it is of; filled in by the link

  friend bool operator==(const Snapshot&, const Snapshot&) = default;
};

// Effect of a download on the program that runs.
enum class DownloadMode : std::uint8_t {
  Replace = 0,              // stops it; the new one is loaded and stays stopped
  Change = 1,               // takes over between two scans with the values, steps and forces of the old one
  ChangeRestartCharts = 2,  // the same, but every chart starts at its initial steps
};

// Summary of an online change; all zero after any other download.
struct ChangeReport {
  std::uint32_t carried = 0;         // variables with the values of the old program
  std::uint32_t initialised = 0;     // new ones, with their initial values
  std::uint32_t dropped = 0;         // of the old program, that the new one lacks
  std::uint32_t retyped = 0;         // of a type that does not take the old values: initial values
  std::uint32_t dropped_forces = 0;  // forces that have no place in the new program
  double pause_us = 0.0;             // by which the change made the scan thread later

  friend bool operator==(const ChangeReport&, const ChangeReport&) = default;
};

struct StartOptions {
  bool barrier = false;  // simulated clock only: stand still at every step change until it is acknowledged
  bool cold = false;     // retained variables have their initial values too
};

using image::ImageBits;

// A request that names memory names its program too, by the hexadecimal digest: an address of one program is
// another variable of the next. The scan thread compares it with the program that is loaded at the moment of
// acting, and refuses any other, and a request that names none (R0009).

// Bits to be forced, released (`value` is ignored then) or written once, before the next scan.
struct ProgramBits {
  std::string program_digest;
  ImageBits bits;

  friend bool operator==(const ProgramBits&, const ProgramBits&) = default;
};

// A force holds until it is released, over stop and start, until its time is over or another program is
// downloaded; an online change takes it along, with the time that it has left. The time is that of the wall,
// with a simulated clock too.
struct ForceRequest {
  ProgramBits place;
  std::uint64_t duration_ms = 0;  // 0: without an end; at most kMaxForceMs

  friend bool operator==(const ForceRequest&, const ForceRequest&) = default;
};

// The forces and their program; the digest is empty where none is loaded.
struct Forces {
  std::string program_digest;
  std::vector<image::Force> places;  // `end_ns`: the time that each has left; image::kNoEnd: no end
};

// Any number of bits (up to kMaxBlockWrites parts) that change between the same two scans, all of them or
// none. Of a part that overlaps another the later one stays.
struct BlockWrite {
  std::string program_digest;
  std::vector<ImageBits> parts;

  friend bool operator==(const BlockWrite&, const BlockWrite&) = default;
};

}  // namespace stepwright::host
