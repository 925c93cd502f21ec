#pragma once

// The Modbus devices that a project of Beremiz keeps beside its plc.xml: folders as
// modbus_0@modbus/ModbusTCPclient_0@ModbusTCPclient/ModbusRequest_0@ModbusRequest, each with its channel. A
// variable at %IW0.1.2.7 is object 7 of request 2 of client 1 of node 0.
//
// Not thread-safe; reads the folder.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stepwright::cell_import {

// What one request of a client reads or writes.
struct ForeignRequest {
  std::vector<std::uint32_t> levels;  // of its variables, but for the last one
  std::string object;  // as [[modbus.device.group]] has it: "coil", "discrete", "input", "holding"
  bool written = false;
  std::uint32_t first = 0;  // of its objects, which are numbered as the device numbers them
  std::uint32_t count = 1;
  std::size_t device = 0;  // index of ForeignDevices::devices
};

struct ForeignDevice {
  std::string name;
  std::string host;  // over TCP; else the line
  std::string port;
  std::string line;
  std::string baud, parity, stop_bits;  // of the line
  std::string unit;
  std::string period_ms;
  std::string timeout_ms;  // empty: none is said
};

struct ForeignDevices {
  std::vector<ForeignDevice> devices;
  std::vector<ForeignRequest> requests;
  std::vector<std::string> left;  // what of the folder was not taken
};

// `folder`: that of the project.
ForeignDevices read_beremiz_devices(const std::filesystem::path& folder);

// Where a variable with an address of several levels is; nothing if no request reaches so far.
struct ForeignObject {
  const ForeignRequest* request;
  std::uint32_t number;
};
std::optional<ForeignObject> object_at(const ForeignDevices& devices, const std::string& address);

}  // namespace stepwright::cell_import
