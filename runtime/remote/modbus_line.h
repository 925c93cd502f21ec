#pragma once

// A controller's registers over Modbus RTU or TCP.
//
//   auto line = ModbusLine::create(SerialEndpoint{.device = "/dev/ttyUSB0"}, 1, 200ms);
//
// Threads: as RegisterLine. Nothing is open until the first `reopen`.

#include <chrono>
#include <memory>

#include "runtime/ground/result/result.h"
#include "runtime/modbus/master/master.h"
#include "runtime/remote/register_line.h"

namespace stepwright::remote {

class ModbusLine final : public RegisterLine {
 public:
  // `timeout`: from a request to the end of its answer. Fails with R0126 for what no line can have.
  [[nodiscard]] static result::Result<std::unique_ptr<RegisterLine>> create(
      const modbus::master::Endpoint& endpoint, std::uint8_t unit, std::chrono::milliseconds timeout);

  LineAnswer read(std::uint16_t first, std::span<std::uint16_t> words) override;
  LineAnswer write(std::uint16_t first, std::span<const std::uint16_t> words) override;
  LineAnswer read_write(std::uint16_t write_first, std::span<const std::uint16_t> write,
                        std::uint16_t read_first, std::span<std::uint16_t> read) override;
  LineAnswer reopen() override;
  std::string name() const override { return name_; }

 private:
  ModbusLine(modbus::master::Master master, std::string name, std::uint8_t unit)
      : master_(std::move(master)), name_(std::move(name)), unit_(unit) {}

  modbus::master::Master master_;
  std::string name_;
  std::uint8_t unit_;
};

}  // namespace stepwright::remote
