#pragma once

// Health of a runtime, beyond its status: distributions and watchdogs of its tasks, and the devices of its
// I/O. Plain data; any thread.

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/host/messages.h"

namespace stepwright::service {

// Source of the image's inputs and sink of its outputs.
enum class IoKind : std::uint8_t {
  SimulatedPlant = 0,  // in the runtime's own process
  SharedMemory = 1,    // another process on the same machine
  Modbus = 2,          // devices, through `stepwright modbus-client`
  Nothing = 3,         // outputs go nowhere, inputs are 0
};

// A device of remote I/O; times count from the start of its client.
struct DeviceHealth {
  std::string name;
  std::string endpoint;
  std::uint8_t unit = 0;
  bool online = false;  // the newest request was answered
  bool lost = false;    // for longer than its configuration allows, or one of its tags
  std::string error;    // the newest; empty if there was none
  std::uint64_t requests = 0;
  std::uint64_t timeouts = 0;
  std::uint64_t exceptions = 0;
  std::uint64_t bad_answers = 0;
  std::uint64_t connection_losses = 0;
  double answer_p50_us = 0.0;
  double answer_p99_us = 0.0;
  double answer_max_us = 0.0;
  std::int64_t answer_age_ms = -1;  // of the newest value that was read or written; -1: never

  friend bool operator==(const DeviceHealth&, const DeviceHealth&) = default;
};

struct RuntimeHealth {
  std::uint32_t readers = 0;  // who follows the runtime; filled in by the link's endpoint
  std::vector<host::TaskDetail> tasks;
  IoKind io = IoKind::SimulatedPlant;
  bool devices_known = false;   // the I/O's own process has answered
  std::string devices_problem;  // why not
  std::vector<DeviceHealth> devices;

  friend bool operator==(const RuntimeHealth&, const RuntimeHealth&) = default;
};

}  // namespace stepwright::service
