#pragma once

// Brings in what is saved: compiles a cell's sources when one of them has changed, and has the running
// program go on as the new one between two scans. What does not compile, or does not fit, leaves everything
// as it is, and is told.
//
//   SourceWatch watch(config, overrides, programs);
//   watch.turn(console);                           // often
//
// Threads: one. Nothing blocks: the commands `compile` and `download` are processes of their own.

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cell/config/cell_config.h"
#include "cell/processes/line_pipe.h"
#include "programs/up/console.h"
#include "runtime/ground/process/child_process.h"

namespace stepwright::up {

class SourceWatch {
 public:
  SourceWatch(const config::CellConfig& config, std::vector<std::string> overrides,
              std::filesystem::path programs);

  void turn(Console& console);

 private:
  using Clock = std::chrono::steady_clock;
  using Times = std::map<std::filesystem::path, std::filesystem::file_time_type>;
  enum class Work : std::uint8_t { None, Compile, Download };

  Times times() const;
  void look();
  void begin(Work work, Console& console);
  void finish(int exit, Console& console);

  const config::CellConfig& config_;
  std::vector<std::string> overrides_;
  std::filesystem::path programs_;
  Times seen_;    // those that were compiled last
  Times newest_;  // as they were at the last look
  bool due_ = false;
  Clock::time_point look_at_{};
  Work work_ = Work::None;
  std::optional<process::ChildProcess> child_;
  processes::LinePipe pipe_;
};

}  // namespace stepwright::up
