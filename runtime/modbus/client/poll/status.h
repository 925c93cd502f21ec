#pragma once

// Status of devices and tags of the Modbus client at an instant. Plain data; any thread.

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/modbus/client/tag.h"
#include "runtime/scan/histogram.h"

namespace stepwright::modbus::client {

struct TagStatus {
  std::string name;
  std::string address;
  bool output = false;
  double value = 0.0;  // as the image has it
  Quality quality = Quality::NotConnected;
  std::int64_t age_ms = 0;                       // since it was read, or acknowledged; -1: never
  std::chrono::system_clock::time_point time{};  // when that was
};

struct GroupStatus {
  std::string name;
  std::int64_t period_ms = 0;
  std::uint64_t turns = 0;
  std::uint64_t overruns = 0;  // periods that were left out because the connection was busy
  scan::Histogram period;      // from the start of one turn to that of the next
};

struct DeviceCounters {
  std::uint64_t requests = 0;
  std::uint64_t timeouts = 0;
  std::uint64_t exceptions = 0;
  std::uint64_t bad_answers = 0;
  std::uint64_t connection_losses = 0;
  std::uint64_t writes = 0;  // of the requests
  scan::Histogram answer;    // from a request to its answer
};

struct DeviceStatus {
  std::string name;
  std::string endpoint;
  std::uint8_t unit = 0;
  bool online = false;  // the newest request was answered
  bool lost = false;    // for longer than loss_after, or one of its tags
  std::string error;    // the newest; empty if there was none
  DeviceCounters counters;
  std::vector<GroupStatus> groups;
  std::vector<TagStatus> tags;
};

// A device came or went.
struct DeviceNews {
  std::string device;
  bool online = false;
  std::string reason;
};

}  // namespace stepwright::modbus::client
