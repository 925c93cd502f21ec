#pragma once

// Journal of a runtime in the log: started, stopped, traps, lost I/O, overruns, lost events, clients,
// supervisors, programs and refused downloads with their digest. It hears of everything from the service.
//
// Threads: the service's. The scan neither logs nor waits for it.

#include <cstdint>
#include <string>

#include "runtime/ground/log/logger.h"
#include "runtime/service/service_observer.h"

namespace stepwright::cell_runtime {

class RuntimeJournal {
 public:
  // The log must outlive it.
  explicit RuntimeJournal(log::Logger& log) : log_(log) {}

  void event(const host::StepEvent& event);
  void status(const host::RuntimeStatus& status);
  void client(const std::string& name, service::Role role, bool came);
  void refusal(const std::string& client, const service::Request& request, const service::Reply& reply);
  void supervisor(bool alive);

 private:
  log::Logger& log_;
  std::string digest_;
  std::uint64_t overruns_ = 0;
  std::uint64_t lost_events_ = 0;
};

}  // namespace stepwright::cell_runtime
