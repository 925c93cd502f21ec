#pragma once

// Serves a controller's registers over a pty (RTU) or loopback (TCP) from one loop, and runs its scans when
// they are due by the clock. One master at a time, as on a line.
//
//   auto slave = Slave::on_pty(registers, model, 1);
//   std::puts(slave->where().c_str());             // "/dev/pts/7"
//   while (going) slave->turn(100ms);
//
// Threads: one.

#include <chrono>
#include <memory>
#include <string>

#include "tests/support/modbus_controller/control_registers.h"

namespace stepwright::support {

class Slave {
 public:
  virtual ~Slave() = default;
  // Waits for a request or a scan that is due, at most `timeout`, and serves it.
  virtual void turn(std::chrono::milliseconds timeout) = 0;
  // The device or "127.0.0.1:PORT".
  virtual std::string where() const = 0;

  // Both throw std::runtime_error if the system refuses. Registers and model must outlive the slave.
  static std::unique_ptr<Slave> on_pty(ControlRegisters& registers, ControllerModel& model,
                                       std::uint8_t unit);
  static std::unique_ptr<Slave> on_loopback(ControlRegisters& registers, ControllerModel& model,
                                            std::uint16_t port);
};

}  // namespace stepwright::support
