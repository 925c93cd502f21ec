#pragma once

// Asks the Modbus client of a cell once a second how its devices are, so that those who follow the runtime
// over Fast DDS know. Of a cell without one it only knows the kind of the I/O.
//
// Threads: its own asks; `fill` from any. Ends within the second that an answer may take.

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "cell/config/cell_config.h"
#include "runtime/dds/health.h"

namespace stepwright::link {

class DeviceWatch {
 public:
  explicit DeviceWatch(const config::CellConfig& config);

  // The I/O's part of `health`, as it was asked for last.
  void fill(dds::RuntimeHealth& health) const;

 private:
  void run(const std::stop_token& stop);
  void ask();

  dds::IoKind kind_;
  std::filesystem::path socket_;
  mutable std::mutex mutex_;  // of what follows
  bool known_ = false;
  std::string problem_;
  std::vector<dds::DeviceHealth> devices_;
  std::jthread thread_;  // last: silent before what it writes to is gone
};

}  // namespace stepwright::link
