#include "runtime/modbus/client/poll/io_client.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace stepwright::modbus::client {

namespace {

// A line has one speed, one format and one gap; all devices on it must say the same.
result::Result<void> check_line(const std::vector<Device>& devices) {
  for (const Device& device : devices) {
    const Device& first = devices.front();
    if (device.endpoint == first.endpoint && device.gap == first.gap) continue;
    return result::fail("R0126", device.where,
                        "'" + device.name + "' and '" + first.name + "' are on " +
                            master::name_of(first.endpoint) + " with different settings",
                        "a line has one speed, parity, size and gap for all units");
  }
  return {};
}

// The devices of one connection, and who asks them.
using Connection = std::pair<std::vector<Device>, master::Master>;

result::Result<std::vector<Connection>> connections_of(const ClientSettings& settings) {
  std::map<std::string, std::vector<Device>> by_place;
  for (const Device& device : settings.devices) by_place[master::name_of(device.endpoint)].push_back(device);
  std::vector<Connection> made;
  for (auto& [name, devices] : by_place) {
    if (auto checked = check_line(devices); !checked) return result::forward(checked);
    master::MasterOptions options;
    options.connect_timeout = settings.connect_timeout;
    options.timeout = devices.front().timeout;
    options.gap = devices.front().gap;
    auto master = master::Master::create(devices.front().endpoint, options);
    if (!master) {
      for (result::Diagnostic& each : master.error()) each.where = devices.front().where;
      return result::forward(master);
    }
    made.emplace_back(std::move(devices), std::move(*master));
  }
  return made;
}

}  // namespace

result::Result<void> IoClient::check(const ClientSettings& settings) {
  if (auto made = connections_of(settings); !made) return result::forward(made);
  return {};
}

result::Result<std::unique_ptr<IoClient>> IoClient::create(const ClientSettings& settings) {
  auto made = connections_of(settings);
  if (!made) return result::forward(made);
  std::unique_ptr<IoClient> client(new IoClient());
  for (auto& [devices, master] : *made) {
    client->workers_.push_back(
        std::make_unique<ConnectionWorker>(std::move(devices), std::move(master), settings));
  }
  return client;
}

void IoClient::set_outputs(std::span<const std::byte> area) {
  for (const auto& worker : workers_) worker->set_outputs(area);
}

void IoClient::collect(std::span<std::byte> inputs) const {
  const auto now = ConnectionWorker::Clock::now();
  for (const auto& worker : workers_) worker->cache().collect(now, inputs);
}

bool IoClient::lost() const {
  const auto now = ConnectionWorker::Clock::now();
  return std::ranges::any_of(workers_, [&](const auto& worker) { return worker->cache().lost(now); });
}

bool IoClient::written() const {
  return std::ranges::all_of(workers_, [](const auto& worker) { return worker->written(); });
}

std::vector<DeviceStatus> IoClient::status() const {
  const auto now = ConnectionWorker::Clock::now();
  std::vector<DeviceStatus> status;
  for (const auto& worker : workers_) worker->cache().report(now, status);
  return status;
}

std::vector<DeviceNews> IoClient::take_news() {
  std::vector<DeviceNews> news;
  for (const auto& worker : workers_) {
    for (DeviceNews& each : worker->cache().take_news()) news.push_back(std::move(each));
  }
  return news;
}

}  // namespace stepwright::modbus::client
