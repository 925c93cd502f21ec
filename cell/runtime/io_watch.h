#pragma once

// Watch over the I/O of a runtime, for what is done about its loss besides making outputs safe: the log and
// the status name the devices that are lost, and where the configuration says so the program is started again
// when they are back.
//
//   IoWatch watch(config, *io, *runtime, log);
//   monitor.attach(watch);
//   while (...) { (*server)->turn(100ms, stop); watch.turn(); }
//
// Threads: the service's; the Modbus client is asked on a thread of its own, as its answer may take time.

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "cell/config/cell_config.h"
#include "cell/runtime/cell_io.h"
#include "cell/runtime/io_restart.h"
#include "runtime/ground/log/logger.h"
#include "runtime/host/host_runtime.h"

namespace stepwright::cell_runtime {

class IoWatch {
 public:
  // References must outlive it.
  IoWatch(const config::CellConfig& config, CellIo& io, host::HostRuntime& runtime, log::Logger& log);

  void event(const host::StepEvent& event);
  // Somebody asked for a stop, whether anything ran or not.
  void stop_asked() { restart_.decided(); }
  void supervisor(bool alive);
  void turn(IoRestart::Clock::time_point now = IoRestart::Clock::now());

 private:
  void ask();
  void tell();
  void tell_other();
  void tell_plant();
  void start();

  const config::CellConfig& config_;
  CellIo& io_;
  host::HostRuntime& runtime_;
  log::Logger& log_;
  IoRestart restart_;
  bool lost_ = false;
  bool plant_told_ = false;  // what has become of the plant's process
  std::uint32_t other_ = 0;  // the process of another runtime that drives the outputs
  bool supervised_ = false;
  std::atomic<bool> asks_{false};
  std::mutex mutex_;  // of the answer
  std::optional<std::string> answer_;
  std::jthread asking_;  // last: it ends before what it writes to
};

}  // namespace stepwright::cell_runtime
