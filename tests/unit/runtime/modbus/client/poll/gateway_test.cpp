// Several units behind one connection: they take turns on it, and a dead one takes its share only.

#include "tests/support/modbus_slave/modbus_slave.h"
#include "tests/unit/runtime/modbus/client/poll/remote_io.h"

namespace stepwright::modbus::client {
namespace {

using support::ModbusSlave;

std::vector<Device> units(std::uint16_t port, int count) {
  std::vector<Device> devices;
  for (int i = 1; i <= count; ++i) {
    devices.push_back(device_at(port, {group_of({word_tag(10, static_cast<std::uint32_t>(i))}, {}, 50ms)},
                                static_cast<std::uint8_t>(i)));
    devices.back().timeout = 200ms;
    devices.back().retry_at_most = 500ms;
  }
  return devices;
}

TEST(Gateway, WhenSeveralUnitsAreBehindIt_ThenTheyShareOneConnection) {
  ModbusSlave slave;
  RemoteIo io(units(slave.port(), 4));
  ASSERT_TRUE(wait_for([&] { return !io.client->lost(); }));
  EXPECT_EQ(io.client->connections(), 1u);
  EXPECT_EQ(slave.connections(), 1);
  for (std::uint8_t unit = 1; unit <= 4; ++unit) EXPECT_GT(slave.requests_of(unit), 0);
}

TEST(Gateway, WhenOneUnitIsDead_ThenItTakesAQuarterOfTheLineAtMost) {
  ModbusSlave slave;
  slave.silence(3, true);
  RemoteIo io(units(slave.port(), 4));
  ASSERT_TRUE(wait_for([&] { return io.status(2).counters.timeouts >= 2; }));
  const int connections = slave.connections();
  std::this_thread::sleep_for(500ms);
  const int dead = slave.requests_of(3);
  const int alive = slave.requests_of(1);
  std::this_thread::sleep_for(3s);
  // Each try costs 200 ms, and after each the others have 600 ms: 3.75 in 3 s.
  EXPECT_LE(slave.requests_of(3) - dead, 5);
  EXPECT_GE(slave.requests_of(3) - dead, 1);
  // 60 periods, of which those within a try are left out.
  EXPECT_GE(slave.requests_of(1) - alive, 30);
  EXPECT_EQ(slave.connections(), connections) << "a dead unit is no reason to connect again";
  EXPECT_TRUE(io.status(0).online);
  EXPECT_FALSE(io.status(2).online);
  std::printf("gateway, 4 units at 50 ms, one dead, 3 s: %d tries of the dead one, %d turns of another\n",
              slave.requests_of(3) - dead, slave.requests_of(1) - alive);
  slave.silence(3, false);
  const auto back = Clock::now();
  EXPECT_TRUE(wait_for([&] { return io.status(2).online; }));
  EXPECT_LT(ms_since(back), 2'000.0);
}

TEST(Gateway, WhenItSaysThatTheTargetIsSilent_ThenTheUnitIsDeadAndTheGatewayIsNot) {
  ModbusSlave slave;
  RemoteIo io(units(slave.port(), 2));
  ASSERT_TRUE(wait_for([&] { return !io.client->lost(); }));
  slave.refuse_with(11);
  ASSERT_TRUE(wait_for([&] { return !io.status(0).online && !io.status(1).online; }));
  EXPECT_NE(io.status(0).error.find("exception 11"), std::string::npos);
  slave.refuse_with(0);
  EXPECT_TRUE(wait_for([&] { return io.status(0).online && io.status(1).online; }));
}

// Each device on a connection of its own: the thread of the dead one waits alone.
TEST(Gateway, WhenDevicesHaveConnectionsOfTheirOwn_ThenASlowOneHoldsUpNobody) {
  ModbusSlave slow;
  ModbusSlave fast;
  slow.answer_after_ms(150);
  RemoteIo io({device_at(slow.port(), {group_of({word_tag(0, 0)})}, 1),
               device_at(fast.port(), {group_of({word_tag(0, 1)})}, 2)});
  EXPECT_EQ(io.client->connections(), 2u);
  ASSERT_TRUE(wait_for([&] { return slow.requests() >= 2; }));
  const int before = fast.requests();
  const int slow_before = slow.requests();
  std::this_thread::sleep_for(1s);
  EXPECT_GE(fast.requests() - before, 25);  // 50 periods
  EXPECT_LE(slow.requests() - slow_before, 8);
}

}  // namespace
}  // namespace stepwright::modbus::client
