#include "programs/link/device_watch.h"

#include <chrono>
#include <utility>

#include "cell/device_status/status_socket.h"
#include "cell/link/device_health.h"
#include "runtime/ground/result/last_barrier.h"

namespace stepwright::link {
namespace {

constexpr std::chrono::seconds kPeriod{1};

dds::IoKind kind_of(const config::CellConfig& config) {
  const config::IoConfig& io = config.safety.io;
  if (io.modbus) return dds::IoKind::Modbus;
  if (io.shared_memory) return dds::IoKind::SharedMemory;
  return config.plant.kind == "none" ? dds::IoKind::Nothing : dds::IoKind::SimulatedPlant;
}

}  // namespace

DeviceWatch::DeviceWatch(const config::CellConfig& config)
    : kind_(kind_of(config)), socket_(config.modbus_client_path()) {
  if (kind_ != dds::IoKind::Modbus) return;
  problem_ = "not asked yet";
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void DeviceWatch::fill(dds::RuntimeHealth& health) const {
  const std::scoped_lock lock(mutex_);
  health.io = kind_;
  health.devices_known = known_;
  health.devices_problem = problem_;
  health.devices = devices_;
}

void DeviceWatch::run(const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any never;
  std::unique_lock lock(mutex);
  while (!stop.stop_requested()) {
    static_cast<void>(result::thrown_by([this] { ask(); }));  // asked again a moment later
    never.wait_for(lock, stop, kPeriod, [] { return false; });
  }
}

void DeviceWatch::ask() {
  const auto text = device_status::ask_status(socket_);
  auto devices = text ? device_health(*text) : std::nullopt;
  const std::scoped_lock lock(mutex_);
  known_ = devices.has_value();
  problem_ = known_ ? ""
             : text ? "the Modbus client says what is not understood"
                    : text.error().front().message;
  devices_ = known_ ? std::move(*devices) : std::vector<dds::DeviceHealth>();
}

}  // namespace stepwright::link
