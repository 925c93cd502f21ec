#pragma once

// Devices, tags and a client between them, as the tests of the poller need them.

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "runtime/modbus/client/poll/conversion.h"
#include "runtime/modbus/client/poll/io_client.h"

namespace stepwright::modbus::client {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

// UINT at word `word` of the image, register `first` of the slave.
inline Tag word_tag(std::uint16_t first, std::uint32_t word, Table table = Table::HoldingRegisters) {
  Tag tag;
  tag.name = "w" + std::to_string(word);
  tag.table = table;
  tag.first = first;
  tag.field = {2 * word, 0, ImageType::Uint};
  return tag;
}

inline Tag bit_tag(Table table, std::uint16_t first, std::uint32_t bit) {
  Tag tag;
  tag.table = table;
  tag.first = first;
  tag.wire = WireType::Bool;
  tag.field = {bit / 8, static_cast<std::uint8_t>(bit % 8), ImageType::Bool};
  return tag;
}

inline Group group_of(std::vector<Tag> inputs, std::vector<Tag> outputs = {},
                      std::chrono::milliseconds period = 20ms) {
  Group group;
  group.period = period;
  group.inputs = std::move(inputs);
  group.outputs = std::move(outputs);
  return group;
}

inline Device device_at(std::uint16_t port, std::vector<Group> groups, std::uint8_t unit = 1) {
  Device device;
  device.name = "d" + std::to_string(unit);
  device.endpoint = master::TcpEndpoint{"127.0.0.1", port};
  device.unit = unit;
  device.groups = std::move(groups);
  return device;
}

// A client with its areas of 512 bytes.
class RemoteIo {
 public:
  explicit RemoteIo(std::vector<Device> devices) : inputs_(512), outputs_(512) {
    ClientSettings settings;
    settings.devices = std::move(devices);
    auto made = IoClient::create(settings);
    EXPECT_TRUE(made) << (made ? "" : result::to_string(made.error()));
    client = std::move(*made);
  }

  std::uint64_t in(std::uint32_t word) { return input({2 * word, 0, ImageType::Uint}); }
  bool in_bit(std::uint32_t bit) {
    return input({bit / 8, static_cast<std::uint8_t>(bit % 8), ImageType::Bool}) != 0;
  }
  int quality(std::uint32_t byte) { return static_cast<int>(input({byte, 0, ImageType::Usint})); }
  void out(std::uint32_t word, std::uint16_t value) {
    put_field(outputs_, {2 * word, 0, ImageType::Uint}, value);
    client->set_outputs(outputs_);
  }
  void out_bit(std::uint32_t bit, bool value) {
    put_field(outputs_, {bit / 8, static_cast<std::uint8_t>(bit % 8), ImageType::Bool}, value ? 1 : 0);
    client->set_outputs(outputs_);
  }
  DeviceStatus status(std::size_t device = 0) { return client->status().at(device); }

  std::unique_ptr<IoClient> client;

 private:
  std::uint64_t input(const ImageField& field) {
    client->collect(inputs_);
    return get_field(inputs_, field);
  }
  std::vector<std::byte> inputs_;
  std::vector<std::byte> outputs_;
};

inline bool wait_for(const std::function<bool()>& condition, std::chrono::milliseconds patience = 60s,
                     std::chrono::microseconds pause = 2ms) {
  const auto deadline = Clock::now() + patience;
  while (!condition()) {
    if (Clock::now() > deadline) return false;
    std::this_thread::sleep_for(pause);
  }
  return true;
}

inline double ms_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

}  // namespace stepwright::modbus::client
