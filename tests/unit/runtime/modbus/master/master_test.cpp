// The master against a slave of libmodbus: every function, every way in which a request can end.

#include "runtime/modbus/master/master.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "tests/support/modbus_slave/modbus_slave.h"

namespace stepwright::modbus::master {
namespace {

using namespace std::chrono_literals;
using support::ModbusSlave;

Master connected(const ModbusSlave& slave, std::chrono::milliseconds timeout = 30s) {
  auto master = Master::create(TcpEndpoint{"127.0.0.1", slave.port()}, {.timeout = timeout});
  EXPECT_TRUE(master);
  EXPECT_TRUE(master->connect().good());
  return std::move(*master);
}

TEST(Master, WhenItWritesAndReads_ThenTheSlaveHasAndGivesTheValues) {
  ModbusSlave slave;
  Master master = connected(slave);
  EXPECT_TRUE(master.write_coil(7, true).good());
  EXPECT_TRUE(slave.coil(7));
  EXPECT_TRUE(master.write_register(3, 0xABCD).good());
  EXPECT_EQ(slave.holding(3), 0xABCD);
  const std::array<std::uint8_t, 3> bits{1, 0, 1};
  EXPECT_TRUE(master.write_coils(20, bits).good());
  EXPECT_TRUE(slave.coil(20) && !slave.coil(21) && slave.coil(22));
  const std::array<std::uint16_t, 2> words{1, 0xFFFF};
  EXPECT_TRUE(master.write_registers(30, words).good());
  EXPECT_EQ(slave.holding(31), 0xFFFF);
  EXPECT_TRUE(master.mask_register(31, 0xFF00, 0x0001).good());
  EXPECT_EQ(slave.holding(31), 0xFF01);

  slave.set_discrete(9, true);
  slave.set_input(5, 55);
  std::array<std::uint8_t, 10> read_bits{};
  EXPECT_TRUE(master.read_bits(BitTable::DiscreteInputs, 0, read_bits).good());
  EXPECT_EQ(read_bits[9], 1);
  EXPECT_EQ(read_bits[8], 0);
  EXPECT_TRUE(master.read_bits(BitTable::Coils, 20, std::span(read_bits).first(3)).good());
  EXPECT_EQ(read_bits[2], 1);
  std::array<std::uint16_t, 2> read{};
  EXPECT_TRUE(master.read_registers(RegisterTable::Input, 5, std::span(read).first(1)).good());
  EXPECT_EQ(read[0], 55);
  EXPECT_TRUE(master.read_write_registers(40, words, 40, read).good());  // the write comes first
  EXPECT_EQ(read[1], 0xFFFF);
}

TEST(Master, WhenARequestIsAsLargeAsItMayBe_ThenItIsAnswered) {
  ModbusSlave slave({.registers = 3'000});
  Master master = connected(slave);
  std::vector<std::uint16_t> words(kMaxWriteRegisters);
  std::iota(words.begin(), words.end(), 1);
  EXPECT_TRUE(master.write_registers(100, words).good());
  std::vector<std::uint16_t> read(kMaxReadRegisters);
  EXPECT_TRUE(master.read_registers(RegisterTable::Holding, 100, read).good());
  EXPECT_TRUE(std::equal(words.begin(), words.end(), read.begin()));
  std::vector<std::uint8_t> bits(kMaxWriteBits, 1);
  EXPECT_TRUE(master.write_coils(0, bits).good());
  std::vector<std::uint8_t> read_bits(kMaxReadBits);
  EXPECT_TRUE(master.read_bits(BitTable::Coils, 0, read_bits).good());
  EXPECT_EQ(std::accumulate(read_bits.begin(), read_bits.end(), 0), static_cast<int>(kMaxWriteBits));
}

TEST(Master, WhenARequestIsOutsideTheProtocol_ThenNothingIsSent) {
  ModbusSlave slave;
  Master master = connected(slave);
  std::vector<std::uint16_t> words(kMaxReadRegisters + 1);
  std::vector<std::uint8_t> bits(kMaxReadBits + 1);
  const auto refused = [](const Outcome& outcome) { return outcome.fault == Fault::BadRequest; };
  EXPECT_TRUE(refused(master.read_registers(RegisterTable::Holding, 0, words)));
  EXPECT_TRUE(refused(master.read_registers(RegisterTable::Holding, 0, {})));
  EXPECT_TRUE(refused(master.read_registers(RegisterTable::Holding, 65'535, std::span(words).first(2))));
  EXPECT_TRUE(refused(master.write_registers(0, std::span(words).first(kMaxWriteRegisters + 1))));
  EXPECT_TRUE(refused(master.read_bits(BitTable::Coils, 0, bits)));
  EXPECT_TRUE(refused(master.write_coils(0, std::span(bits).first(kMaxWriteBits + 1))));
  EXPECT_TRUE(refused(master.read_write_registers(0, std::span(words).first(kMaxWriteInReadWrite + 1), 0,
                                                  std::span(words).first(1))));
  EXPECT_TRUE(refused(master.select_unit(248)));
  EXPECT_EQ(slave.requests(), 0);
}

TEST(Master, WhenTheSlaveRefuses_ThenTheExceptionIsKnownAndTheConnectionGoesOn) {
  ModbusSlave slave;
  Master master = connected(slave);
  std::array<std::uint16_t, 2> words{};
  const Outcome outcome = master.read_registers(RegisterTable::Holding, 999, words);
  EXPECT_EQ(outcome.fault, Fault::Exception);
  EXPECT_EQ(outcome.exception, 2);
  EXPECT_EQ(outcome.text(), "exception 2 (illegal data address)");
  slave.refuse_with(6);
  EXPECT_EQ(master.write_register(0, 1).exception, 6);
  slave.refuse_with(0);
  EXPECT_TRUE(master.write_register(0, 1).good());
  EXPECT_EQ(slave.connections(), 1);
}

TEST(Master, WhenAnAnswerIsLate_ThenItIsATimeoutAndNotTheAnswerOfTheNextRequest) {
  ModbusSlave slave;
  Master master = connected(slave, 50ms);
  slave.set_holding(0, 11);
  slave.set_holding(1, 22);
  slave.answer_after_ms(100);
  std::array<std::uint16_t, 1> word{};
  EXPECT_EQ(master.read_registers(RegisterTable::Holding, 0, word).fault, Fault::Timeout);
  EXPECT_TRUE(master.connected());
  slave.answer_after_ms(0);
  master.set_timeout(30s);
  ASSERT_TRUE(master.read_registers(RegisterTable::Holding, 1, word).good());
  EXPECT_EQ(word[0], 22);
}

TEST(Master, WhenNobodyListens_ThenItSaysSoAtOnce) {
  std::uint16_t port = 0;
  {
    const ModbusSlave slave;
    port = slave.port();
  }
  auto master = Master::create(TcpEndpoint{"127.0.0.1", port}, {});
  ASSERT_TRUE(master);
  const Outcome outcome = master->connect();
  EXPECT_EQ(outcome.fault, Fault::NotConnected);
  EXPECT_EQ(outcome.system_error, ECONNREFUSED);
  EXPECT_EQ(master->write_register(0, 1).fault, Fault::NotConnected);
  const auto told = outcome.result({"press", 0, 0});
  ASSERT_FALSE(told);
  EXPECT_EQ(told.error()[0].code, "R0121");
  EXPECT_NE(told.error()[0].message.find("refused"), std::string::npos);
}

TEST(Master, WhenTheSlaveGoes_ThenTheConnectionIsLostAndAnotherOneCanBeHad) {
  auto slave = std::make_unique<ModbusSlave>();
  Master master = connected(*slave);
  EXPECT_TRUE(master.write_register(0, 1).good());
  const std::uint16_t port = slave->port();
  slave.reset();
  EXPECT_EQ(master.write_register(0, 1).fault, Fault::ConnectionLost);
  EXPECT_FALSE(master.connected());
  slave = std::make_unique<ModbusSlave>(support::ModbusSlaveOptions{.port = port});
  EXPECT_TRUE(master.connect().good());
  EXPECT_TRUE(master.write_register(0, 1).good());
}

TEST(Master, WhenAnEndpointCannotBe_ThenItIsRefused) {
  const auto refused = [](const Endpoint& endpoint) {
    const auto master = Master::create(endpoint, {});
    return !master && master.error()[0].code == "R0126";
  };
  EXPECT_TRUE(refused(TcpEndpoint{"", 502}));
  EXPECT_TRUE(refused(TcpEndpoint{"a", 0}));
  EXPECT_TRUE(refused(SerialEndpoint{}));
  EXPECT_TRUE(refused(SerialEndpoint{.device = "/dev/x", .baud = 19'201}));
  EXPECT_TRUE(refused(SerialEndpoint{.device = "/dev/x", .data_bits = 9}));
  EXPECT_EQ(name_of(TcpEndpoint{"::1", 502}), "[::1]:502");
}

}  // namespace
}  // namespace stepwright::modbus::master
