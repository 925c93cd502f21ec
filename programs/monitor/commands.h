#pragma once

// The commands for people who look at a runtime. Each attaches to the runtime of a cell, does its work and
// returns the exit code; what is wrong went to stderr. Threads: one.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cell/config/cell_config.h"

namespace stepwright::monitor {

struct StartArguments {
  bool cold = false;  // retained variables have their initial values too
};
int start(const config::CellConfig& config, const StartArguments& arguments);
int stop(const config::CellConfig& config);

struct ForceArguments {
  std::string name;
  std::string value;
  bool all = false;      // unforce: everything
  double seconds = 0.0;  // force: how long; 0: without an end
  std::string json_file;
};
int force(const config::CellConfig& config, const ForceArguments& arguments);
int unforce(const config::CellConfig& config, const ForceArguments& arguments);
int list_forces(const config::CellConfig& config, const ForceArguments& arguments);

struct FaultArguments {
  std::string name;  // of the plant's
  std::optional<double> value;
  bool clear = false;  // it ends instead
};
int fault(const config::CellConfig& config, const FaultArguments& arguments);

struct WatchArguments {
  std::vector<std::string> names;
  std::string list_file;  // more names, one a line
  std::uint32_t period_ms = 500;
  std::uint64_t count = 0;  // samples; 0: until it is interrupted
  std::string json_file;
};
int watch(const config::CellConfig& config, const WatchArguments& arguments);
// All values of one scan; all variables where none is named.
int snapshot(const config::CellConfig& config, const WatchArguments& arguments);

struct StepArguments {
  std::uint64_t scans = 1;
  bool changes = false;
  std::string json_file;
};
int step(const config::CellConfig& config, const StepArguments& arguments);
int go_on(const config::CellConfig& config);

struct RecordArguments {
  std::string file;
  double seconds = 0.0;  // 0: until it is interrupted
  bool detach = false;   // begin and leave it running
  bool stop = false;
  bool status = false;
  std::uint64_t max_mb = 0;
  std::uint32_t hash_every = 1;
  std::uint32_t keyframe_every = 1'000;
  std::string json_file;
};
int record(const config::CellConfig& config, const RecordArguments& arguments);

struct TraceArguments {
  std::vector<std::string> names;
  std::string list_file;
  std::string csv_file;
  double seconds = 1.0;
};
int trace_to_csv(const config::CellConfig& config, const TraceArguments& arguments);

}  // namespace stepwright::monitor
