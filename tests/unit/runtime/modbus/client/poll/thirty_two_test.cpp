// Slaves on connections of their own, one of them dead: the thread of the dead one waits alone.

#include <algorithm>

#include "tests/support/modbus_slave/modbus_slave.h"
#include "tests/unit/runtime/modbus/client/poll/remote_io.h"

namespace stepwright::modbus::client {
namespace {

using support::ModbusSlave;

constexpr std::size_t kSlaves = 32;
constexpr std::size_t kDead = 11;
constexpr std::uint64_t kTurns = 10;

constexpr std::uint8_t kDeadUnit = kDead + 1;

// The status has the devices in an order of its own.
std::uint64_t turns_of_slowest(RemoteIo& io) {
  std::uint64_t fewest = UINT64_MAX;
  for (const DeviceStatus& device : io.client->status()) {
    if (device.unit != kDeadUnit) fewest = std::min(fewest, device.groups[0].turns);
  }
  return fewest;
}

std::uint64_t timeouts_of_the_dead(RemoteIo& io) {
  const auto status = io.client->status();
  return std::ranges::find(status, kDeadUnit, &DeviceStatus::unit)->counters.timeouts;
}

// What is waited for one answer of the dead one would do for 300 periods: on a machine that is busy with
// other things, too, all others have their turns meanwhile.
TEST(ThirtyTwoSlaves, WhenOneIsDead_ThenAllOthersHaveTheirTurnsDuringASingleWaitForIt) {
  std::vector<std::unique_ptr<ModbusSlave>> slaves;
  std::vector<Device> devices;
  for (std::size_t i = 0; i < kSlaves; ++i) {
    slaves.push_back(std::make_unique<ModbusSlave>());
    devices.push_back(device_at(slaves[i]->port(),
                                {group_of({word_tag(0, static_cast<std::uint32_t>(i))}, {}, 100ms)},
                                static_cast<std::uint8_t>(i + 1)));
    devices.back().timeout = 30s;
  }
  slaves[kDead]->silence(kDeadUnit, true);
  RemoteIo io(std::move(devices));
  EXPECT_EQ(io.client->connections(), kSlaves);
  ASSERT_TRUE(wait_for([&] { return slaves[kDead]->requests() == 1; }));
  const std::uint64_t before = turns_of_slowest(io);
  EXPECT_TRUE(wait_for([&] { return turns_of_slowest(io) >= before + kTurns; }));
  EXPECT_EQ(timeouts_of_the_dead(io), 0u) << "it is still waited for";
  EXPECT_EQ(slaves[kDead]->requests(), 1);
  slaves[kDead].reset();  // ends that wait
}

}  // namespace
}  // namespace stepwright::modbus::client
