// 32 slaves at 100 ms, with and without a dead one: the periods of the others are the same.

#include "tests/support/modbus_slave/modbus_slave.h"
#include "tests/unit/runtime/modbus/client/poll/remote_io.h"

namespace stepwright::modbus::client {
namespace {

using support::ModbusSlave;

constexpr std::size_t kSlaves = 32;
constexpr std::size_t kDead = 11;

struct Periods {
  scan::Histogram all;
  std::uint64_t overruns = 0;
  std::uint64_t dead_requests = 0;
};

// The periods of all slaves but that one, over `time`.
Periods poll(std::vector<std::unique_ptr<ModbusSlave>>& slaves, std::chrono::milliseconds time) {
  std::vector<Device> devices;
  for (std::size_t i = 0; i < kSlaves; ++i) {
    devices.push_back(device_at(slaves[i]->port(),
                                {group_of({word_tag(0, static_cast<std::uint32_t>(i))}, {}, 100ms)},
                                static_cast<std::uint8_t>(i + 1)));
  }
  RemoteIo io(std::move(devices));
  EXPECT_EQ(io.client->connections(), kSlaves);
  std::this_thread::sleep_for(time);
  Periods periods;
  for (const DeviceStatus& device : io.client->status()) {
    if (device.unit == kDead + 1) {
      periods.dead_requests = device.counters.timeouts;
      continue;
    }
    periods.all.add(device.groups[0].period);
    periods.overruns += device.groups[0].overruns;
  }
  return periods;
}

void print(const char* what, const Periods& periods) {
  const auto ms = [&](std::uint32_t part) {
    return static_cast<double>(periods.all.percentile_ns(part)) / 1e6;
  };
  std::printf("%-14s %llu periods of 31 slaves: p50 %.2f ms, p99 %.2f ms, max %.2f ms, %llu left out\n", what,
              static_cast<unsigned long long>(periods.all.count()), ms(50'000), ms(99'000),
              static_cast<double>(periods.all.max_ns()) / 1e6,
              static_cast<unsigned long long>(periods.overruns));
}

TEST(ThirtyTwoSlaves, WhenOneIsDead_ThenItAddsNothingToThePeriodsOfTheOthers) {
  std::vector<std::unique_ptr<ModbusSlave>> slaves;
  for (std::size_t i = 0; i < kSlaves; ++i) slaves.push_back(std::make_unique<ModbusSlave>());
  const Periods without = poll(slaves, 2'500ms);
  slaves[kDead]->silence(kDead + 1, true);
  const Periods with = poll(slaves, 2'500ms);
  print("without", without);
  print("with a dead one", with);
  EXPECT_GE(with.dead_requests, 2u) << "the dead one was asked";
  EXPECT_GE(with.all.count(), 31u * 18u);
  EXPECT_NEAR(static_cast<double>(with.all.percentile_ns(50'000)), 100e6, 5e6);
  // A wait for the dead one would add 300 ms; what is allowed here is the machine's other work.
  EXPECT_LT(with.all.percentile_ns(99'000), without.all.percentile_ns(99'000) + 50'000'000);
}

}  // namespace
}  // namespace stepwright::modbus::client
