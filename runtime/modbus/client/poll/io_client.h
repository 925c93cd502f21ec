#pragma once

// Remote I/O over Modbus as a whole: all devices of a cell, each connection with a poller of its own, between
// the input and the output area of the process image.
//
//   auto client = IoClient::create(settings);
//   while (going) { client.set_outputs(outputs); client.collect(inputs); plant.beat_unless(client.lost()); }
//
// Threads: one calls; each connection has another. No call waits for a slave, but the destructor for requests
// that are on their way (one timeout at most).

#include <chrono>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "runtime/ground/result/result.h"
#include "runtime/modbus/client/poll/connection_worker.h"
#include "runtime/modbus/client/poll/status.h"
#include "runtime/modbus/client/settings.h"

namespace stepwright::modbus::client {

class IoClient {
 public:
  // Begins to poll. Fails with what Master::create refuses and where devices of one line want different
  // settings of it (R0126). Requires tags that lie within the areas.
  [[nodiscard]] static result::Result<std::unique_ptr<IoClient>> create(const ClientSettings& settings);

  // Checks the settings as create does, without a thread or a connection.
  [[nodiscard]] static result::Result<void> check(const ClientSettings& settings);

  // As long as none were set, nothing is written to any slave.
  void set_outputs(std::span<const std::byte> area);
  // Writes what belongs to devices; leaves the rest of the area alone.
  void collect(std::span<std::byte> inputs) const;
  // A device with OnLoss::Safe is lost, or not there yet.
  bool lost() const;
  // Every slave that answers has what was set last.
  bool written() const;

  std::vector<DeviceStatus> status() const;
  std::vector<DeviceNews> take_news();
  std::size_t connections() const { return workers_.size(); }

 private:
  IoClient() = default;
  std::vector<std::unique_ptr<ConnectionWorker>> workers_;
};

}  // namespace stepwright::modbus::client
