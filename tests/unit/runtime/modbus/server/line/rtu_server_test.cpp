// The server on a serial line, as a master sees it.

#include <gtest/gtest.h>
#include <poll.h>

#include <array>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "runtime/modbus/pdu/crc16.h"
#include "runtime/modbus/server/line/line_acceptor.h"
#include "runtime/modbus/server/server.h"
#include "tests/support/patience.h"
#include "tests/unit/runtime/modbus/server/line/pty.h"
#include "tests/unit/runtime/modbus/server/support/table_data.h"

namespace stepwright::modbus::server {
namespace {

using std::chrono::milliseconds;
using Bytes = std::vector<std::uint8_t>;
using Clock = std::chrono::steady_clock;

constexpr std::uint8_t kUnit = 17;
constexpr int kTurns = 50;
using support::kPatience;
constexpr milliseconds kShort{80};  // longer than the silence that the server notices

Bytes framed(std::uint8_t address, Bytes pdu) {
  pdu.insert(pdu.begin(), address);
  const std::uint16_t crc = pdu::crc16(std::as_bytes(std::span(pdu)));
  pdu.push_back(static_cast<std::uint8_t>(crc));
  pdu.push_back(static_cast<std::uint8_t>(crc >> 8));
  return pdu;
}

const Bytes kRead = framed(kUnit, {3, 0, 1, 0, 1});
const Bytes kAnswer = framed(kUnit, {3, 2, 0x12, 0x34});

class RtuServer : public testing::Test {
 protected:
  RtuServer() {
    data.registers[1] = 0x1234;
    ServerOptions options;
    ClientRule everybody;
    everybody.read = everybody.write = {{map::Table::HoldingRegisters}};
    options.clients = {everybody};
    server = std::move(*Server::create(options, data));
    LineOptions line;
    line.device = pty.device;
    line.parity = Parity::None;
    line.unit = kUnit;
    server->add(LineAcceptor::create(line, nullptr, milliseconds(20)));
    while (server->figures().connections == 0) server->turn(milliseconds(10));
  }

  void send(const Bytes& bytes) const {
    ASSERT_EQ(::write(pty.master, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  // What the server has sent when it has sent `count` bytes, or when the time is over and the server has had
  // its turns, whatever else the machine did meanwhile: it has seen a silence then.
  Bytes receive(std::size_t count, milliseconds patience = kPatience) {
    Bytes got;
    const auto end = Clock::now() + patience;
    for (int turns = 0; (Clock::now() < end || turns < kTurns) && got.size() < count; ++turns) {
      server->turn(milliseconds(1));
      std::array<std::uint8_t, 512> buffer;
      const auto bytes = ::read(pty.master, buffer.data(), buffer.size());
      if (bytes > 0) got.insert(got.end(), buffer.begin(), buffer.begin() + bytes);
    }
    return got;
  }
  Bytes ask(const Bytes& frame, std::size_t answer = kAnswer.size()) {
    send(frame);
    return receive(answer);
  }
  bool is_silent() { return receive(1, kShort).empty(); }

  Pty pty;
  TableData data;
  std::unique_ptr<Server> server;
};

TEST_F(RtuServer, Request_WhenItIsForThisUnit_ThenIsAnswered) {
  EXPECT_EQ(ask(kRead), kAnswer);
  const Bytes refused = framed(kUnit, {0x83, 2});
  EXPECT_EQ(ask(framed(kUnit, {3, 0, 99, 0, 2}), refused.size()), refused);
}

TEST_F(RtuServer, Request_WhenItIsForAnotherUnit_ThenIsNotAnsweredAndNorIsItsAnswer) {
  send(framed(18, {3, 0, 1, 0, 1}));
  send(framed(18, {3, 2, 0, 7}));
  EXPECT_TRUE(is_silent());
  EXPECT_EQ(ask(kRead), kAnswer);
}

TEST_F(RtuServer, Broadcast_WhenItWrites_ThenIsCarriedOutWithoutAnAnswer) {
  send(framed(0, {6, 0, 5, 0xAB, 0xCD}));
  const auto end = Clock::now() + kPatience;
  do {
    EXPECT_TRUE(is_silent());
  } while (data.registers[5] != 0xABCD && Clock::now() < end);
  EXPECT_EQ(data.registers[5], 0xABCD);
  send(framed(0, {3, 0, 1, 0, 1}));
  EXPECT_TRUE(is_silent());
  EXPECT_EQ(ask(kRead), kAnswer);
}

TEST_F(RtuServer, Write_WhenTheControllerTakesTime_ThenIsAnsweredAfterIt) {
  data.held = true;
  const Bytes write = framed(kUnit, {6, 0, 5, 0, 9});
  send(write);
  EXPECT_TRUE(is_silent());
  data.release();
  EXPECT_EQ(receive(write.size()), write);
}

TEST_F(RtuServer, Request_WhenItComesByteByByte_ThenIsAnswered) {
  for (const std::uint8_t byte : kRead) {
    send({byte});
    server->turn(milliseconds(0));
  }
  EXPECT_EQ(receive(kAnswer.size()), kAnswer);
}

TEST_F(RtuServer, Noise_WhenItIsBeforeARequest_ThenTheRequestIsAnswered) {
  Bytes noisy{0x00, 0xFF, 0x80, 0x55, 0xAA, 0xFF};
  noisy.insert(noisy.end(), kRead.begin(), kRead.end());
  EXPECT_EQ(ask(noisy), kAnswer);
}

TEST_F(RtuServer, Request_WhenItsCrcIsWrong_ThenIsNotAnsweredAndTheNextIs) {
  Bytes wrong = kRead;
  wrong.back() ^= 1;
  send(wrong);
  EXPECT_TRUE(is_silent());
  EXPECT_EQ(ask(kRead), kAnswer);
}

TEST_F(RtuServer, Request_WhenItIsCutOff_ThenASilenceMakesRoomForTheNext) {
  // The longest kind of request begins, and never ends.
  send({kUnit, 16, 0, 0, 0, 123, 246, 1, 2, 3});
  EXPECT_TRUE(is_silent());
  EXPECT_EQ(ask(kRead), kAnswer);
}

TEST_F(RtuServer, Line_WhenItGoesAway_ThenTheServerGoesOnAndOpensItAgain) {
  EXPECT_EQ(ask(kRead), kAnswer);
  pty.close();
  for (const auto end = Clock::now() + kPatience; Clock::now() < end && server->figures().connections > 0;)
    server->turn(milliseconds(5));
  EXPECT_EQ(server->figures().connections, 0u);
  server->turn(milliseconds(30));
  server->turn(milliseconds(30));
  EXPECT_EQ(server->figures().connections, 0u) << "the device is no longer there";
}

}  // namespace
}  // namespace stepwright::modbus::server
