#pragma once

// Carries what the service of a runtime says and is told over Fast DDS. It keeps nothing that matters: killed
// and started again, clients repeat their requests, fetch the events they missed, and the runtime has gone on
// meanwhile.
//
// Threads: one, beside those of Fast DDS inside the endpoint.

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "programs/link/device_watch.h"
#include "runtime/dds/link_endpoint.h"
#include "runtime/ground/log/logger.h"
#include "runtime/service/connection.h"

namespace stepwright::link {

class Bridge {
 public:
  // Log and devices must outlive it.
  Bridge(std::unique_ptr<dds::LinkEndpoint> endpoint, std::filesystem::path socket,
         const DeviceWatch& devices, log::Logger& log)
      : endpoint_(std::move(endpoint)), socket_(std::move(socket)), devices_(devices), log_(log) {}

  // Waits for something to pass on, a moment at most, and passes it on.
  void turn(int stop_descriptor);

 private:
  using Clock = std::chrono::steady_clock;

  void connect();
  void pass_requests();
  void pass_messages();
  void pass(const service::Message& message);
  void keep_alive();
  void publish_status();
  void publish_snapshot();
  std::chrono::milliseconds pause() const;
  void publish_health();
  void look_for_namesakes();
  bool runtime_answers() const;

  std::unique_ptr<dds::LinkEndpoint> endpoint_;
  std::filesystem::path socket_;
  const DeviceWatch& devices_;
  log::Logger& log_;
  std::unique_ptr<service::Connection> connection_;  // null while no runtime serves the socket
  host::RuntimeStatus status_;                       // the newest
  bool was_answering_ = false;
  bool was_supervised_ = false;
  std::vector<std::string> namesakes_;  // as they were told last
  Clock::time_point heard_{};           // a status of the runtime
  Clock::time_point alive_at_{};
  Clock::time_point snapshot_at_{};
  Clock::time_point health_at_{};
  Clock::time_point connect_at_{};
};

}  // namespace stepwright::link
