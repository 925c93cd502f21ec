#pragma once

// Supervisor of the processes of one cell: keeps them alive, from the first start to the end in order.
//
//   auto supervisor = ProcessSupervisor::make(setting, console);
//   return to_int(supervisor->run(stop));
//
// They are started one after the other, each when the one before has said that it is ready. If one of them
// fails before all are, all are ended again: no half of a cell is left. Afterwards a process that ends is
// started again, and so is one that hangs; one that fails again and again is left alone, and the others go
// on.
//
// Threads: one.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cell/config/cell_config.h"
#include "cell/processes/cell_record.h"
#include "cell/processes/kept_process.h"
#include "programs/up/console.h"
#include "programs/up/source_watch.h"
#include "runtime/ground/process/notify_listener.h"
#include "runtime/ground/process/notify_socket.h"
#include "runtime/ground/process/stop_signal.h"
#include "runtime/ground/result/exit_code.h"

namespace stepwright::up {

struct ProcessSupervisorSetting {
  const config::CellConfig& config;
  std::vector<std::string> overrides = {};  // for every process
  std::filesystem::path programs = {};      // the folder of the executables
  bool watch = false;
  bool terminal = true;  // somebody can press Ctrl-C
  // Every process is ready. RuntimeFault: the program that the cell names is not loaded.
  std::function<void(result::ExitCode)> on_up = [](result::ExitCode) {};
};

class ProcessSupervisor {
 public:
  // Before any is started it fails with M0001 if one of the programs is missing, with E0002 if the state
  // folder takes no record of them; M0014.
  [[nodiscard]] static result::Result<std::unique_ptr<ProcessSupervisor>> make(
      ProcessSupervisorSetting setting, Console& console);
  ~ProcessSupervisor();

  // Returns at `stop`, or when the cell could not be brought up.
  result::ExitCode run(const process::StopSignal& stop);

 private:
  using Clock = std::chrono::steady_clock;

  ProcessSupervisor(ProcessSupervisorSetting setting, Console& console, process::NotifyListener listener)
      : setting_(std::move(setting)), console_(console), listener_(std::move(listener)) {}
  void start_next();
  // Waits for news, and passes them on.
  void turn(const process::StopSignal* stop);
  void print_lines(processes::KeptProcess& member);
  void become_ready();
  void tell_token();
  void tell_failure(const processes::KeptProcess& member);
  void end_all();
  void kill(processes::KeptProcess& member);
  processes::CellRecord record() const;
  void keep_record();
  const processes::KeptProcess* failed() const;
  processes::KeptProcess* find(const std::string& name);

  ProcessSupervisorSetting setting_;
  Console& console_;
  process::NotifyListener listener_;
  process::NotifySocket init_;  // of whoever has started this process
  std::vector<processes::KeptProcess> members_;
  std::size_t begun_ = 0;  // so many of them were started
  Clock::time_point begun_at_{};
  bool patience_told_ = false;
  bool ready_ = false;
  std::string address_;  // of the page
  std::string token_;    // that nobody was told yet
  std::vector<std::string> told_failed_;
  std::vector<std::string> killed_;  // at the end
  std::optional<processes::CellRecord> kept_;
  bool record_fails_ = false;
  Clock::time_point next_try_{};  // of a record that could not be written
  std::optional<SourceWatch> watch_;
};

}  // namespace stepwright::up
