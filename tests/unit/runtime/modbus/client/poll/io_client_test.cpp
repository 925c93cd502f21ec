// The client against slaves of libmodbus over TCP: values come and go, losses show, what is refused is
// refused alone.

#include "runtime/modbus/client/poll/io_client.h"

#include "tests/support/given_time.h"
#include "tests/support/modbus_slave/modbus_slave.h"
#include "tests/unit/runtime/modbus/client/poll/remote_io.h"

namespace stepwright::modbus::client {
namespace {

using support::ModbusSlave;

TEST(IoClient, WhenTheSlaveHasValues_ThenTheyAreInTheImage) {
  ModbusSlave slave;
  slave.set_holding(10, 111);
  slave.set_input(20, 222);
  slave.set_discrete(3, true);
  slave.set_coil(4, true);
  RemoteIo io({device_at(slave.port(),
                         {group_of({word_tag(10, 0), word_tag(20, 1, Table::InputRegisters),
                                    bit_tag(Table::DiscreteInputs, 3, 33), bit_tag(Table::Coils, 4, 34)})})});
  EXPECT_TRUE(io.client->lost());
  ASSERT_TRUE(wait_for([&] { return !io.client->lost(); }));
  EXPECT_EQ(io.in(0), 111u);
  EXPECT_EQ(io.in(1), 222u);
  EXPECT_TRUE(io.in_bit(33) && io.in_bit(34) && !io.in_bit(35));
  slave.set_holding(10, 112);
  EXPECT_TRUE(wait_for([&] { return io.in(0) == 112; }));
  EXPECT_EQ(slave.connections(), 1);
}

TEST(IoClient, WhenItIsCheckedOnly_ThenItSaysWhatCreateWouldAndAsksNobody) {
  ModbusSlave slave;
  ClientSettings settings;
  settings.devices.push_back(device_at(slave.port(), {group_of({word_tag(10, 0)})}));
  EXPECT_TRUE(IoClient::check(settings));
  EXPECT_EQ(slave.connections(), 0);
  settings.devices[0].endpoint = master::SerialEndpoint{.device = "/dev/ttyS9", .baud = 12'345};
  settings.devices[0].where = {"cell.toml", 7, 3};
  const auto checked = IoClient::check(settings);
  const auto created = IoClient::create(settings);
  ASSERT_FALSE(checked);
  ASSERT_FALSE(created);
  EXPECT_EQ(checked.error().front().code, "R0126");
  EXPECT_EQ(checked.error().front().where.line, 7u);
  EXPECT_EQ(result::to_string(checked.error()), result::to_string(created.error()));
}

TEST(IoClient, WhenNoOutputWasSet_ThenNothingIsWritten) {
  ModbusSlave slave;
  slave.set_holding(50, 7);
  RemoteIo io({device_at(slave.port(), {group_of({word_tag(10, 0)}, {word_tag(50, 0)})})});
  ASSERT_TRUE(wait_for([&] { return slave.requests() > 5; }));
  EXPECT_EQ(slave.holding(50), 7);
  io.out(0, 0);  // zero, too, is a value
  EXPECT_TRUE(wait_for([&] { return slave.holding(50) == 0; }));
}

TEST(IoClient, WhenOutputsChange_ThenTheyAreWrittenOnceAndAtOnce) {
  ModbusSlave slave;
  Device device =
      device_at(slave.port(), {group_of({}, {word_tag(50, 0), bit_tag(Table::Coils, 6, 100)}, 10s)});
  device.refresh = 0ms;
  device.timeout = 30s;  // no request is repeated
  RemoteIo io({device});
  io.out(0, 5);
  ASSERT_TRUE(wait_for([&] { return io.client->written(); }));
  EXPECT_EQ(slave.holding(50), 5);
  const int before = slave.requests();
  io.out(0, 6);
  ASSERT_TRUE(wait_for([&] { return io.client->written(); }));  // long before the period of 10 s is over
  EXPECT_EQ(slave.holding(50), 6);
  EXPECT_EQ(slave.requests(), before + 1);
  io.out_bit(100, true);
  ASSERT_TRUE(wait_for([&] { return slave.coil(6); }));
  std::this_thread::sleep_for(100ms);
  EXPECT_EQ(slave.requests(), before + 2);
  EXPECT_EQ(slave.history().back()[0], 5);  // one coil: FC 5
}

TEST(IoClient, WhenTheGroupIsCyclic_ThenItIsWrittenEveryPeriod) {
  ModbusSlave slave;
  Group group = group_of({}, {word_tag(50, 0)}, 20ms);
  group.write = WriteMode::Cyclic;
  Device device = device_at(slave.port(), {group});
  device.single_writes = false;
  RemoteIo io({device});
  io.out(0, 5);
  EXPECT_TRUE(wait_for([&] { return slave.requests() >= 10; }));
  EXPECT_EQ(slave.history().back()[0], 16);
}

TEST(IoClient, WhenABitOfARegisterIsWritten_ThenItsOtherBitsStay) {
  ModbusSlave slave;
  slave.set_holding(50, 0xF00F);
  Tag tag = bit_tag(Table::HoldingRegisters, 50, 100);
  tag.bit = 8;
  RemoteIo io({device_at(slave.port(), {group_of({}, {tag})})});
  io.out_bit(100, true);
  ASSERT_TRUE(wait_for([&] { return slave.holding(50) == 0xF10F; }));
  EXPECT_EQ(slave.history().back()[0], 22);
}

TEST(IoClient, WhenTheSlaveGoesAndComesBack_ThenValuesAndOutputsDoSo) {
  auto slave = std::make_unique<ModbusSlave>();
  const std::uint16_t port = slave->port();
  slave->set_holding(10, 1);
  Tag tag = word_tag(10, 0);
  tag.on_loss = LossValue::Value;
  tag.loss_value = 99;
  tag.quality_byte = 20;
  Device device = device_at(port, {group_of({tag}, {word_tag(50, 0)})});
  device.loss_after = 200ms;
  RemoteIo io({device});
  io.out(0, 5);
  ASSERT_TRUE(wait_for([&] { return !io.client->lost() && io.client->written(); }));
  EXPECT_EQ(io.in(0), 1u);
  EXPECT_EQ(io.quality(20), 192);
  const support::GivenTime given;
  const auto begin = Clock::now();
  slave.reset();
  ASSERT_TRUE(wait_for([&] { return io.quality(20) == 68; }));
  EXPECT_EQ(io.in(0), 1u);
  ASSERT_TRUE(wait_for([&] { return io.client->lost(); }));
  EXPECT_GT(ms_since(begin), 150.0);
  EXPECT_LT(given.ms(), 2'000.0);
  EXPECT_EQ(io.quality(20), 8);
  EXPECT_EQ(io.in(0), 99u);
  EXPECT_FALSE(io.status().online);
  slave = std::make_unique<ModbusSlave>(
      support::ModbusSlaveOptions{.port = port});  // it has forgotten everything
  slave->set_holding(10, 2);
  const double back_ms = given.ms();
  ASSERT_TRUE(wait_for([&] { return !io.client->lost() && io.in(0) == 2; }));
  EXPECT_LT(given.ms() - back_ms, 2'000.0);
  EXPECT_TRUE(wait_for([&] { return slave->holding(50) == 5; }));
}

TEST(IoClient, WhenOneAddressOfARequestIsRefused_ThenTheOtherTagsAreGood) {
  ModbusSlave slave({.registers = 40});
  slave.set_holding(5, 55);
  slave.set_holding(7, 77);
  Device device =
      device_at(slave.port(), {group_of({word_tag(5, 0), word_tag(7, 1), word_tag(60, 2), word_tag(6, 3)})});
  device.max_gap = 100;
  device.groups[0].inputs[2].quality_byte = 20;
  RemoteIo io({device});
  ASSERT_TRUE(wait_for([&] { return io.in(0) == 55 && io.in(1) == 77; }));
  // What was refused together is asked one by one: the others come first, this one and its reason later.
  EXPECT_TRUE(wait_for([&] { return io.quality(20) == 12; }));
  EXPECT_TRUE(wait_for([&] { return io.status().tags[3].quality == Quality::Good; }));
  EXPECT_TRUE(wait_for([&] { return io.status().error.find("illegal data address") != std::string::npos; }));
  EXPECT_TRUE(io.status().online);
}

TEST(IoClient, WhenTheSlaveRefusesAWrite_ThenReadingGoesOnAndItIsTriedAgain) {
  ModbusSlave slave({.registers = 40});
  Device device = device_at(slave.port(), {group_of({word_tag(5, 0)}, {word_tag(60, 0), word_tag(20, 1)})});
  device.loss_after = 300ms;
  RemoteIo io({device});
  ASSERT_TRUE(wait_for([&] { return !io.client->lost(); }));
  io.out(1, 3);
  ASSERT_TRUE(wait_for([&] { return slave.holding(20) == 3; }));
  EXPECT_FALSE(io.client->written());
  EXPECT_TRUE(wait_for([&] { return io.client->lost(); }));  // an output that does not arrive is lost I/O
  const int before = slave.requests();
  EXPECT_TRUE(wait_for([&] { return slave.requests() > before + 5; }));
}

TEST(IoClient, WhenTheEndpointCannotBe_ThenItIsRefused) {
  ClientSettings settings;
  settings.devices = {device_at(502, {})};
  settings.devices[0].endpoint = master::SerialEndpoint{.device = "/dev/x", .baud = 1};
  const auto client = IoClient::create(settings);
  ASSERT_FALSE(client);
  EXPECT_EQ(client.error()[0].code, "R0126");
}

}  // namespace
}  // namespace stepwright::modbus::client
