#pragma once

// One run of a cell with all its processes, from start to report. A process that dies is started again, as an
// init system would do; a process that refuses its input ends the run.

#include <atomic>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "programs/demo/controller_choice.h"
#include "programs/demo/emulator_line.h"
#include "runtime/ground/process/child_process.h"
#include "runtime/ground/process/notify_listener.h"
#include "runtime/ground/result/exit_code.h"
#include "runtime/ground/result/result.h"
#include "supervisor/run/report.h"

namespace stepwright::demo {

struct CellRunOptions {
  std::filesystem::path config;
  std::vector<std::string> overrides;  // KEY=VALUE
  std::filesystem::path state_dir;     // of this run; logs go there too
  bool page = false;                   // with the HMI, until `stop` is set
  std::string scan = "runtime";        // what the supervisor commands: "runtime", or "gateway"
  std::optional<EmulatedController> emulator = std::nullopt;  // behind the gateway, started before it
};

struct CellRunResult {
  result::ExitCode exit = result::ExitCode::Done;
  std::optional<run::Report> report;
  std::vector<std::string> processes;   // that took part
  std::map<std::string, int> restarts;  // by process
  std::string message;                  // what a process said when it refused
};

class CellRun {
 public:
  explicit CellRun(CellRunOptions options);

  // Blocks until the supervisor has reported (and, with a page, until `stop`).
  [[nodiscard]] result::Result<CellRunResult> run(const std::atomic<bool>& stop);

 private:
  struct Member {
    std::string name;
    process::ChildProcess process;
    EmulatorLine line = {};   // of an emulator
    bool ready = false;       // as it has said itself
    std::string status = {};  // what it has said with it
  };
  [[nodiscard]] result::Result<Member> start(const std::string& name) const;
  [[nodiscard]] result::Result<Member> start_emulator() const;
  [[nodiscard]] result::Result<void> start_all(std::vector<Member>& members, CellRunResult& result) const;
  // False if the run is over.
  [[nodiscard]] result::Result<bool> tend(Member& member, CellRunResult& result);
  // What the processes have said of themselves since.
  void hear(std::vector<Member>& members);
  // Where the page is, once page and supervisor are ready: before that one of them may still refuse the cell.
  static std::optional<std::string> page_of(const std::vector<Member>& members);
  void take_report(CellRunResult& result) const;
  // Of a supervisor that ended so without one.
  void tell_missing_report(const process::ExitStatus& ended, CellRunResult& result) const;
  std::filesystem::path log_of(const std::string& name) const;
  std::filesystem::path line_link() const;  // leads to the emulator's line

  CellRunOptions options_;
  std::filesystem::path programs_;  // the folder of the executables
  std::optional<process::NotifyListener> listener_;
};

}  // namespace stepwright::demo
