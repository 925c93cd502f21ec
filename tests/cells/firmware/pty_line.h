#pragma once

// The master at the pty of a board: libmodbus without the silence that a real line needs between two frames.
// Threads: one.

#include <chrono>
#include <stdexcept>
#include <string>
#include <utility>

#include "runtime/modbus/master/master.h"
#include "runtime/remote/register_line.h"

namespace stepwright::firmware_test {

class PtyLine final : public remote::RegisterLine {
 public:
  // Throws std::runtime_error if it cannot be opened.
  explicit PtyLine(const modbus::master::SerialEndpoint& endpoint)
      : name_(endpoint.device), master_(create(endpoint)) {
    if (!reopen().ok()) throw std::runtime_error(name_ + " cannot be opened");
  }

  remote::LineAnswer read(std::uint16_t first, std::span<std::uint16_t> words) override {
    return answer(master_.read_registers(modbus::master::RegisterTable::Holding, first, words));
  }
  remote::LineAnswer write(std::uint16_t first, std::span<const std::uint16_t> words) override {
    return answer(master_.write_registers(first, words));
  }
  remote::LineAnswer read_write(std::uint16_t write_first, std::span<const std::uint16_t> write,
                                std::uint16_t read_first, std::span<std::uint16_t> read) override {
    return answer(master_.read_write_registers(write_first, write, read_first, read));
  }
  remote::LineAnswer reopen() override { return answer(master_.connect()); }
  std::string name() const override { return name_; }

 private:
  static modbus::master::Master create(const modbus::master::SerialEndpoint& endpoint) {
    auto master = modbus::master::Master::create(
        endpoint, {.timeout = std::chrono::milliseconds(5'000), .gap = std::chrono::microseconds(0)});
    if (!master) throw std::runtime_error(result::to_string(master.error()));
    if (!master->select_unit(1).good()) throw std::runtime_error("no unit 1");
    return std::move(*master);
  }
  static remote::LineAnswer answer(const modbus::master::Outcome& outcome) {
    using modbus::master::Fault;
    if (outcome.good()) return {};
    const auto fault = outcome.fault == Fault::Exception   ? remote::LineFault::Refused
                       : outcome.fault == Fault::Timeout   ? remote::LineFault::Silent
                       : outcome.fault == Fault::BadAnswer ? remote::LineFault::Garbled
                                                           : remote::LineFault::Closed;
    return {fault, outcome.exception, outcome.text()};
  }

  std::string name_;
  modbus::master::Master master_;
};

}  // namespace stepwright::firmware_test
