#pragma once

#include <cstdint>

namespace stepwright::modbus::pdu {

// Exception codes of the Modbus Application Protocol V1.1b3, section 7. None is ours: the request is carried
// out and its answer is a normal one.
enum class Exception : std::uint8_t {
  None = 0,
  IllegalFunction = 1,
  IllegalDataAddress = 2,
  IllegalDataValue = 3,
  DeviceFailure = 4,
  Acknowledge = 5,
  DeviceBusy = 6,
  MemoryParity = 8,
  GatewayPathUnavailable = 10,
  GatewayTargetFailed = 11,
};

}  // namespace stepwright::modbus::pdu
