#pragma once

// Interface for observers of a runtime's service: the log, the watchdog of the init system. The service only
// reports; the program that contains the runtime decides what is done.
//
//   class Journal final : public ServiceObserver {
//     void on_event(const host::StepEvent& event) override;
//   };
//   auto server = Server::create({.socket = path, .observer = &journal}, *runtime);
//
// Threads: the service's; never that of the scan. A function may take a moment (a line in a file), as no scan
// waits for it.

#include <string>

#include "runtime/host/messages.h"
#include "runtime/service/messages.h"

namespace stepwright::service {

class ServiceObserver {
 public:
  virtual ~ServiceObserver() = default;

  // Every event, in order, once.
  virtual void on_event(const host::StepEvent&) {}
  // After every change and at least every kStatusPeriod, whether somebody listens or not.
  virtual void on_status(const host::RuntimeStatus&) {}
  // A client has said hello, or is gone.
  virtual void on_client(const std::string& /*name*/, Role /*role*/, bool /*came*/) {}
  // A request of a client was refused at once; the reply says why.
  virtual void on_refusal(const std::string& /*client*/, const Request&, const Reply&) {}
  // Somebody asks for the configuration to be read again. An error means that nothing has changed; notes say
  // what is in force now and what needs a restart.
  virtual result::Diagnostics on_reload() { return {}; }
  // A client asks for a stop, whether anything runs or not.
  virtual void on_stop() {}
  // A supervisor came, or was not heard of for too long.
  virtual void on_supervisor(bool /*alive*/) {}
};

}  // namespace stepwright::service
