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

// How much of the line a dead one takes is a matter of the schedule (poll_schedule_test.cpp).
TEST(Gateway, WhenOneUnitIsDead_ThenTheOthersAreReadAllTheSameAndItComesBack) {
  ModbusSlave slave;
  slave.silence(3, true);
  RemoteIo io(units(slave.port(), 4));
  ASSERT_TRUE(wait_for([&] { return io.status(2).counters.timeouts >= 4; }));
  const int alive = slave.requests_of(1);
  EXPECT_TRUE(wait_for([&] { return slave.requests_of(1) >= alive + 10 && io.status(0).online; }));
  EXPECT_FALSE(io.status(2).online);
  slave.silence(3, false);
  EXPECT_TRUE(wait_for([&] { return io.status(2).online; }));
}

TEST(Gateway, WhenItSaysThatTheTargetIsSilent_ThenTheUnitIsDeadAndTheGatewayIsNot) {
  ModbusSlave slave;
  RemoteIo io(units(slave.port(), 2));
  ASSERT_TRUE(wait_for([&] { return !io.client->lost(); }));
  slave.refuse_with(11);
  ASSERT_TRUE(wait_for([&] {
    return !io.status(0).online && !io.status(1).online &&
           io.status(0).error.find("exception 11") != std::string::npos;
  }));
  slave.refuse_with(0);
  EXPECT_TRUE(wait_for([&] { return io.status(0).online && io.status(1).online; }));
}

}  // namespace
}  // namespace stepwright::modbus::client
