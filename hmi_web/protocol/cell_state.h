#pragma once

// Everything that changes from snapshot to snapshot, as a viewer sees it: values of one scan and the figures
// of the runtime at that time.
//
// Invariant: `points` has one entry per point of the synoptic and `tags` one per tag of the program with the
// digest `program_digest`; an entry without a value is unknown, unless it has a text. Steps and transitions
// are indices into that program, ascending. What `unread` names has a value in the image, which is none of
// the plant.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace stepwright::protocol {

struct ScanFigures {
  std::uint64_t overruns = 0;
  double p50_us = 0;
  double p99_us = 0;
  double max_us = 0;
  double realtime_factor = 0;

  friend bool operator==(const ScanFigures&, const ScanFigures&) = default;
};

// Why the inputs of a device have no value.
enum class Unread : std::uint8_t {
  Lost,    // it has answered, and does not any more: what stands there is old
  Never,   // it has not answered yet
  Untold,  // nobody says how it is: the process that asks it does not run, or has only begun
};
const char* to_string(Unread why);

// A device that does not answer, and the tags of the program that are read from it.
struct UnreadDevice {
  std::string device;
  Unread why = Unread::Untold;
  std::vector<std::uint32_t> tags;  // by their index, ascending

  friend bool operator==(const UnreadDevice&, const UnreadDevice&) = default;
};

struct CellState {
  bool runtime_alive = false;     // the link and the runtime behind it answer
  bool runtime_unlinked = false;  // a runtime runs beside the server, and no link
  bool supervisor_alive = false;
  std::string runtime_state;   // "empty", "stopped", "running", "fault"; empty = not known
  std::string runtime_detail;  // a sentence about a fault
  bool waiting = false;        // the simulated clock stands still for the supervisor's decision
  std::string program_digest;  // of the program whose steps and tags these are; empty = none
  std::uint64_t scan = 0;
  double time_s = 0;       // the cell's clock
  std::string trace_hash;  // hex
  ScanFigures figures;
  std::vector<std::uint32_t> active_steps;
  std::vector<std::uint32_t> true_transitions;
  std::vector<std::optional<double>> points;
  std::vector<std::optional<double>> tags;
  std::vector<std::uint32_t> reals;            // indices of the tags of the type REAL, ascending
  std::map<std::uint32_t, std::string> texts;  // of tags that people read as text, by their index
  std::vector<UnreadDevice> unread;

  friend bool operator==(const CellState&, const CellState&) = default;
};

// One sample of the points that are drawn over time, in their order in the synoptic.
struct TrendRow {
  double time_s = 0;
  std::vector<std::optional<double>> values;
};

}  // namespace stepwright::protocol
