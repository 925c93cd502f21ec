#pragma once

// Monitor of the runtime's process, for all but serving: it keeps the log, tells the init system how it is,
// and reads the configuration again when asked to.
//
//   ProcessMonitor monitor(config, *log, init);
//   auto server = service::Server::create({..., .observer = &monitor}, *runtime);
//   monitor.attach(**server, *runtime);
//   while (...) { (*server)->turn(100ms, stop); monitor.turn(); }
//
// Threads: the service's. The watchdog of the init system is fed from here, so that it falls silent when
// either the service or the scan hangs.

#include <chrono>
#include <functional>
#include <string>
#include <utility>

#include "cell/config/cell_config.h"
#include "cell/runtime/io_watch.h"
#include "cell/runtime/runtime_journal.h"
#include "cell/runtime/scan_pulse.h"
#include "runtime/ground/log/logger.h"
#include "runtime/ground/process/notify_socket.h"
#include "runtime/host/runtime_port.h"
#include "runtime/service/server.h"

namespace stepwright::cell_runtime {

class ProcessMonitor final : public service::ServiceObserver {
 public:
  // Log and init system must outlive it.
  ProcessMonitor(config::CellConfig config, log::Logger& log, process::NotifySocket& init);

  void attach(service::Server& server, const host::RuntimePort& port);
  // Hears of events, stops and supervisors, too.
  void attach(IoWatch& watch) { watch_ = &watch; }
  // Registers a listener for every status.
  void tell(std::function<void(const host::RuntimeStatus&)> listener) { listener_ = std::move(listener); }
  // Between two turns of the service.
  void turn();
  // Reads the file again. Errors: nothing has changed; notes: what has, and what needs a restart.
  result::Diagnostics reload();

  void on_event(const host::StepEvent& event) override;
  void on_stop() override;
  void on_status(const host::RuntimeStatus& status) override;
  void on_client(const std::string& name, service::Role role, bool came) override {
    journal_.client(name, role, came);
  }
  void on_refusal(const std::string& client, const service::Request& request,
                  const service::Reply& reply) override {
    journal_.refusal(client, request, reply);
  }
  void on_supervisor(bool alive) override;
  result::Diagnostics on_reload() override { return reload(); }

 private:
  void tell_state(const host::RuntimeStatus& status);

  config::CellConfig config_;
  log::Logger& log_;
  process::NotifySocket& init_;
  process::Heartbeat heartbeat_;
  RuntimeJournal journal_;
  ScanPulse pulse_;
  service::Server* server_ = nullptr;
  const host::RuntimePort* port_ = nullptr;
  IoWatch* watch_ = nullptr;  // of a runtime whose I/O can be lost
  std::string digest_;        // of the program whose period the pulse knows
  std::string told_;          // the state that the init system knows
  std::function<void(const host::RuntimeStatus&)> listener_;
};

}  // namespace stepwright::cell_runtime
