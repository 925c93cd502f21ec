// Slaves that answer wrongly, on purpose: nothing of what they say reaches the values, and no request takes
// longer than its timeout.

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <functional>
#include <random>
#include <thread>
#include <vector>

#include "runtime/modbus/master/master.h"
#include "runtime/modbus/pdu/crc16.h"
#include "tests/support/modbus_slave/raw_slave.h"

namespace stepwright::modbus::master {
namespace {

using namespace std::chrono_literals;
using support::RawSlave;
using support::say;
using Bytes = RawSlave::Bytes;

// The right answer to FC 3 with two registers, to be spoilt.
Bytes right(const Bytes& request) {
  return {request[0], request[1], 0, 0, 0, 7, request[6], 3, 4, 0, 1, 0, 2};
}

Outcome ask(const RawSlave& slave, std::chrono::milliseconds timeout = 30s) {
  auto master = Master::create(TcpEndpoint{"127.0.0.1", slave.port()}, {.timeout = timeout});
  EXPECT_TRUE(master->connect().good());
  std::array<std::uint16_t, 2> words{77, 77};
  const Outcome outcome = master->read_registers(RegisterTable::Holding, 0, words);
  EXPECT_EQ(words[0], outcome.good() ? 1 : 77) << "a refused answer reached the values";
  return outcome;
}

TEST(HostileSlave, WhenTheAnswerIsRight_ThenItIsTaken) {
  RawSlave slave([](int client, const Bytes& request) { say(client, right(request)); });
  EXPECT_TRUE(ask(slave).good());
}

TEST(HostileSlave, WhenOneThingOfTheAnswerIsWrong_ThenItIsABadAnswer) {
  // Transaction, protocol, unit, the header's length, function, byte count, and the count that goes with a
  // longer frame.
  const std::vector<std::function<void(Bytes&)>> faults = {
      [](Bytes& bytes) { bytes[1] ^= 0x40; },
      [](Bytes& bytes) { bytes[3] = 1; },
      [](Bytes& bytes) { bytes[6] ^= 1; },
      [](Bytes& bytes) { bytes[5] = 6; },
      [](Bytes& bytes) {
        bytes[5] = 8;
        bytes.push_back(0);
      },
      [](Bytes& bytes) { bytes[7] = 4; },
      [](Bytes& bytes) { bytes[7] = 0x84; },
      [](Bytes& bytes) {
        bytes.insert(bytes.end(), {0, 3});
        bytes[5] = 9;
        bytes[8] = 6;
      },
      [](Bytes& bytes) {
        bytes[8] = 2;
        bytes[5] = 5;
        bytes.resize(11);
      },
      [](Bytes& bytes) {
        bytes[8] = 255;
        bytes[4] = 1;
        bytes[5] = 2;
        bytes.resize(264);
      },
  };
  for (std::size_t i = 0; i < faults.size(); ++i) {
    RawSlave slave([&](int client, const Bytes& request) {
      Bytes bytes = right(request);
      faults[i](bytes);
      say(client, bytes);
    });
    EXPECT_EQ(ask(slave).fault, Fault::BadAnswer) << "fault " << i;
  }
}

// Each byte comes within the timeout, so that a wait for each of them would end with the right answer.
TEST(HostileSlave, WhenTheAnswerDrips_ThenTheTimeoutHoldsForTheWhole) {
  RawSlave slave([](int client, const Bytes& request) {
    for (const std::uint8_t byte : right(request)) {
      say(client, {byte});
      std::this_thread::sleep_for(60ms);
    }
  });
  EXPECT_EQ(ask(slave, 200ms).fault, Fault::Timeout);
}

TEST(HostileSlave, WhenItClosesInTheMiddle_ThenTheConnectionIsLost) {
  RawSlave slave([](int client, const Bytes& request) {
    Bytes bytes = right(request);
    bytes.resize(9);
    say(client, bytes);
    shutdown(client, SHUT_RDWR);
  });
  EXPECT_EQ(ask(slave).fault, Fault::ConnectionLost);
}

TEST(HostileSlave, WhenItSendsWithoutEnd_ThenTheNextRequestGivesUp) {
  RawSlave slave([](int client, const Bytes&) { say(client, Bytes(200'000, 0x55)); });
  auto master = Master::create(TcpEndpoint{"127.0.0.1", slave.port()}, {.timeout = 100ms});
  ASSERT_TRUE(master->connect().good());
  std::array<std::uint16_t, 2> words{};
  EXPECT_FALSE(master->read_registers(RegisterTable::Holding, 0, words).good());
  EXPECT_FALSE(master->connected());
}

// Its echo of "input 700, one register" looks like an answer with the register 16#BC00, but for its length.
TEST(HostileSlave, WhenItEchoes_ThenNoReadTakesThatForAnAnswer) {
  RawSlave slave([](int client, const Bytes& request) { say(client, request); });
  auto master = Master::create(TcpEndpoint{"127.0.0.1", slave.port()}, {.timeout = 30s});
  for (const std::size_t count : {1, 2, 3, 125}) {
    ASSERT_TRUE(master->connect().good());
    std::vector<std::uint16_t> words(count, 7);
    EXPECT_EQ(master->read_registers(RegisterTable::Input, 700, words).fault, Fault::BadAnswer) << count;
    EXPECT_EQ(words[0], 7);
  }
}

TEST(HostileSlave, WhenItAnswersTwiceOrAddsBytes_ThenTheNextRequestHasItsOwnAnswer) {
  for (const bool twice : {true, false}) {
    std::uint8_t value = 0;
    RawSlave slave([&](int client, const Bytes& request) {
      Bytes bytes = right(request);
      bytes[10] = ++value;
      const Bytes more = twice ? bytes : Bytes{0, 0};
      bytes.insert(bytes.end(), more.begin(), more.end());
      say(client, bytes);
    });
    auto master = Master::create(TcpEndpoint{"127.0.0.1", slave.port()}, {.timeout = 30s});
    ASSERT_TRUE(master->connect().good());
    for (std::uint16_t i = 1; i <= 50; ++i) {
      std::array<std::uint16_t, 2> words{};
      ASSERT_TRUE(master->read_registers(RegisterTable::Holding, 0, words).good()) << i;
      EXPECT_EQ(words[0], i);
    }
    EXPECT_EQ(slave.connections(), 1);
  }
}

// Of a request that was given up: its transaction says so.
TEST(HostileSlave, WhenAnAnswerComesWithTheNextOne_ThenItIsPassedOver) {
  Bytes held;
  RawSlave slave([&](int client, const Bytes& request) {
    Bytes bytes = right(request);
    bytes[12] = request[1];
    if (held.empty()) {
      held = bytes;
      return;
    }
    Bytes both = held;
    both.insert(both.end(), bytes.begin(), bytes.end());
    say(client, both);
  });
  auto master = Master::create(TcpEndpoint{"127.0.0.1", slave.port()}, {.timeout = 50ms});
  ASSERT_TRUE(master->connect().good());
  std::array<std::uint16_t, 2> words{};
  EXPECT_EQ(master->read_registers(RegisterTable::Holding, 0, words).fault, Fault::Timeout);
  master->set_timeout(30s);
  EXPECT_TRUE(master->read_registers(RegisterTable::Holding, 0, words).good());
  EXPECT_EQ(words[1], 2) << "the second transaction's";
}

// Frames of a serial line, as a converter passes them on.
TEST(HostileSlave, WhenFramesAreThoseOfALine_ThenChecksumUnitAndLengthAreLookedAt) {
  using Fault_of = std::function<void(Bytes&)>;
  const std::vector<std::pair<Fault_of, Fault>> cases = {
      {[](Bytes&) {}, Fault::None},
      {[](Bytes& bytes) { bytes[0] ^= 1; }, Fault::BadAnswer},
      {[](Bytes& bytes) { bytes[1] = 4; }, Fault::BadAnswer},
      {[](Bytes& bytes) { bytes[2] = 6; }, Fault::BadAnswer},
      {[](Bytes& bytes) { bytes.pop_back(); }, Fault::Timeout},
      {[](Bytes& bytes) {
         bytes = {1, 0x83, 2};
       },
       Fault::Exception},
  };
  for (std::size_t i = 0; i < cases.size(); ++i) {
    RawSlave slave([&](int client, const Bytes& request) {
      EXPECT_EQ(Bytes(request.begin(), request.end() - 2), (Bytes{1, 3, 0, 0, 0, 2}));
      Bytes bytes = {1, 3, 4, 0, 1, 0, 2};
      cases[i].first(bytes);
      const std::uint16_t crc = pdu::crc16(std::as_bytes(std::span(bytes)));
      bytes.push_back(static_cast<std::uint8_t>(crc & 0xFF));
      bytes.push_back(static_cast<std::uint8_t>(crc >> 8));
      say(client, bytes);
    });
    const auto timeout = cases[i].second == Fault::Timeout ? 200ms : 30'000ms;
    auto master = Master::create(TcpEndpoint{"127.0.0.1", slave.port(), Framing::Rtu}, {.timeout = timeout});
    ASSERT_TRUE(master->connect().good());
    std::array<std::uint16_t, 2> words{};
    EXPECT_EQ(master->read_registers(RegisterTable::Holding, 0, words).fault, cases[i].second) << i;
    EXPECT_EQ(words[1], i == 0 ? 2 : 0);
  }
}

// Under the sanitizers this is the proof that no answer can do harm.
TEST(HostileSlave, WhenAnswersAreRandom_ThenNoneIsTakenForMoreThanItIs) {
  std::mt19937 random(5);
  RawSlave slave([&](int client, const Bytes& request) {
    Bytes bytes = right(request);
    for (int i = 0; i < 3; ++i) {
      const std::size_t at = random() % bytes.size();
      if (at != 4) bytes[at] = static_cast<std::uint8_t>(random());  // a long frame would only be waited for
    }
    bytes.resize(bytes.size() + random() % 4, 0xEE);
    say(client, bytes);
  });
  auto master = Master::create(TcpEndpoint{"127.0.0.1", slave.port()}, {.timeout = 5ms});
  int taken = 0;
  for (int i = 0; i < 400; ++i) {
    if (!master->connected()) {
      ASSERT_TRUE(master->connect().good());
    }
    std::array<std::uint16_t, 2> words{};
    const Outcome outcome = master->read_registers(RegisterTable::Holding, 0, words);
    taken += outcome.good() ? 1 : 0;
  }
  EXPECT_LT(taken, 200);  // those whose random bytes fell on values
}

}  // namespace
}  // namespace stepwright::modbus::master
