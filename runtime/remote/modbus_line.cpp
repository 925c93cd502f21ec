#include "runtime/remote/modbus_line.h"

#include <filesystem>
#include <utility>

namespace stepwright::remote {
namespace {

using modbus::master::Fault;
using modbus::master::Master;
using modbus::master::Outcome;

LineAnswer answer_of(const Outcome& outcome) {
  switch (outcome.fault) {
    case Fault::None:
      return {};
    case Fault::Timeout:
      return {LineFault::Silent, 0, {}};
    case Fault::Exception:
      return {LineFault::Refused, outcome.exception, {}};
    case Fault::NotConnected:
    case Fault::ConnectionLost:
      return {LineFault::Closed, 0, outcome.text()};
    case Fault::BadAnswer:
    case Fault::BadRequest:
      break;
  }
  return {LineFault::Garbled, 0, outcome.text()};
}

// A pty has no speed, so that no silence is needed before a request.
std::chrono::microseconds gap_of(const modbus::master::Endpoint& endpoint) {
  constexpr std::chrono::microseconds kByStandard{-1};
  const auto* serial = std::get_if<modbus::master::SerialEndpoint>(&endpoint);
  if (serial == nullptr) return kByStandard;
  std::error_code error;
  const auto device = std::filesystem::canonical(serial->device, error);
  return !error && device.native().starts_with("/dev/pts/") ? std::chrono::microseconds(0) : kByStandard;
}

}  // namespace

result::Result<std::unique_ptr<RegisterLine>> ModbusLine::create(const modbus::master::Endpoint& endpoint,
                                                                 std::uint8_t unit,
                                                                 std::chrono::milliseconds timeout) {
  auto master =
      Master::create(endpoint, {.timeout = timeout, .connect_timeout = timeout, .gap = gap_of(endpoint)});
  if (!master) return result::forward(master);
  return std::unique_ptr<RegisterLine>(
      new ModbusLine(std::move(*master), modbus::master::name_of(endpoint), unit));
}

LineAnswer ModbusLine::read(std::uint16_t first, std::span<std::uint16_t> words) {
  return answer_of(master_.read_registers(modbus::master::RegisterTable::Holding, first, words));
}

LineAnswer ModbusLine::write(std::uint16_t first, std::span<const std::uint16_t> words) {
  return answer_of(master_.write_registers(first, words));
}

LineAnswer ModbusLine::read_write(std::uint16_t write_first, std::span<const std::uint16_t> write,
                                  std::uint16_t read_first, std::span<std::uint16_t> read) {
  return answer_of(master_.read_write_registers(write_first, write, read_first, read));
}

LineAnswer ModbusLine::reopen() {
  master_.close();
  const LineAnswer opened = answer_of(master_.connect());
  return opened.ok() ? answer_of(master_.select_unit(unit_)) : opened;
}

}  // namespace stepwright::remote
