#pragma once

// Brings in what is saved: compiles a cell's sources when one of them has changed, and has the running
// program go on as the new one between two scans. What does not compile, or does not fit, leaves everything
// as it is, and is told. So is a source that is gone, and a file that only a new start of the cell reads.
//
//   SourceWatch watch(config, overrides, programs);
//   watch.turn(console);                           // often
//
// Threads: one. Nothing blocks: the commands `compile` and `download` are processes of their own.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cell/config/cell_config.h"
#include "cell/processes/line_pipe.h"
#include "programs/up/console.h"
#include "programs/up/file_times.h"
#include "programs/up/memory_file.h"
#include "runtime/ground/process/child_process.h"

namespace stepwright::up {

class SourceWatch {
 public:
  SourceWatch(const config::CellConfig& config, std::vector<std::string> overrides,
              std::filesystem::path programs);

  void turn(Console& console);

 private:
  enum class Work : std::uint8_t { None, Compile, Download };

  void look_at_settings(Console& console);
  void begin(Work work, Console& console);
  void finish(int exit, Console& console);

  const config::CellConfig& config_;
  std::vector<std::string> overrides_;
  std::filesystem::path programs_;
  FileTimes sources_;
  FileTimes settings_;  // files that only a new start reads
  Work work_ = Work::None;
  std::optional<MemoryFile> image_;  // that is being compiled to
  std::optional<process::ChildProcess> child_;
  processes::LinePipe pipe_;
};

}  // namespace stepwright::up
