// Connections that are cut again and again, at random instants, with a reset or half open: fresh values are
// back within a second. 100 cuts; STEPWRIGHT_CUTS=1000 makes it a thousand.

#include <algorithm>
#include <cstdlib>
#include <random>

#include "tests/support/given_time.h"
#include "tests/support/modbus_slave/cut_proxy.h"
#include "tests/support/modbus_slave/modbus_slave.h"
#include "tests/unit/runtime/modbus/client/poll/remote_io.h"

namespace stepwright::modbus::client {
namespace {

using support::CutProxy;
using support::GivenTime;
using support::ModbusSlave;

struct Cut {
  bool half_open = false;
  double back_ms = 0.0;  // of time that the machine gave
};

// One device with the settings that a cell has by itself, cut `count` times.
void cut(const GivenTime& given, int seed, int count, std::vector<Cut>& cuts) {
  ModbusSlave slave;
  CutProxy proxy(slave.port());
  RemoteIo io({device_at(proxy.port(), {group_of({word_tag(0, 0)}, {word_tag(1, 0)}, 100ms)})});
  ASSERT_TRUE(wait_for([&] { return !io.client->lost(); }));
  std::mt19937 random(static_cast<unsigned>(seed));
  for (int i = 1; i <= count; ++i) {
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 150'000));
    const bool half_open = random() % 2 == 0;
    half_open ? proxy.freeze() : proxy.reset();
    const double begin_ms = given.ms();
    const auto mark = static_cast<std::uint16_t>(i);
    slave.set_holding(0, mark);
    io.out(0, mark);
    ASSERT_TRUE(wait_for([&] { return io.in(0) == mark && slave.holding(1) == mark; })) << "cut " << i;
    cuts.push_back({half_open, given.ms() - begin_ms});
  }
}

void report(const char* kind, std::vector<double> times) {
  if (times.empty()) return;
  std::ranges::sort(times);
  std::printf("%zu %s cuts: back after p50 %.0f ms, p99 %.0f ms, max %.0f ms\n", times.size(), kind,
              times[times.size() / 2], times[times.size() * 99 / 100], times.back());
}

TEST(Reconnect, WhenTheConnectionIsCutAtRandom_ThenFreshValuesAreBackWithinASecond) {
  constexpr int kDevices = 5;
  const char* const asked = std::getenv("STEPWRIGHT_CUTS");
  const int cuts = asked != nullptr ? std::atoi(asked) : 100;
  std::vector<std::vector<Cut>> made(kDevices);
  const GivenTime given;
  std::vector<std::thread> threads;
  for (int i = 0; i < kDevices; ++i)
    threads.emplace_back(
        [&made, &given, i, cuts] { cut(given, i + 1, cuts / kDevices, made[static_cast<std::size_t>(i)]); });
  for (std::thread& thread : threads) thread.join();
  std::vector<double> reset;
  std::vector<double> half_open;
  for (const auto& of_device : made) {
    ASSERT_EQ(of_device.size(), static_cast<std::size_t>(cuts / kDevices));
    for (const Cut& each : of_device) (each.half_open ? half_open : reset).push_back(each.back_ms);
  }
  report("reset", reset);
  report("half-open", half_open);
  EXPECT_LT(*std::ranges::max_element(reset), 1'000.0);
  EXPECT_LT(*std::ranges::max_element(half_open), 1'000.0);
}

// Behind a gateway the first silence may be that of a unit; the second one is the connection's.
TEST(Reconnect, WhenTheConnectionOfAGatewayIsHalfOpen_ThenAllUnitsAreBackWithinASecond) {
  ModbusSlave slave;
  CutProxy proxy(slave.port());
  std::vector<Device> devices;
  for (std::uint8_t unit = 1; unit <= 8; ++unit)
    devices.push_back(device_at(proxy.port(), {group_of({word_tag(0, unit)}, {}, 100ms)}, unit));
  RemoteIo io(std::move(devices));
  ASSERT_TRUE(wait_for([&] { return !io.client->lost(); }));
  const GivenTime given;
  for (std::uint16_t mark = 1; mark <= 5; ++mark) {
    proxy.freeze();
    const double begin_ms = given.ms();
    slave.set_holding(0, mark);
    ASSERT_TRUE(wait_for([&] {
      for (std::uint32_t unit = 1; unit <= 8; ++unit) {
        if (io.in(unit) != mark) return false;
      }
      return true;
    }));
    EXPECT_LT(given.ms() - begin_ms, 1'000.0);
  }
}

}  // namespace
}  // namespace stepwright::modbus::client
