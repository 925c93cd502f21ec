// Slaves that answer wrongly, on purpose: nothing of what they say reaches the values, and no request takes
// longer than its timeout.

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <functional>
#include <random>
#include <thread>
#include <vector>

#include "runtime/modbus/master/master.h"

namespace stepwright::modbus::master {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;

// Accepts one connection after the other and answers each request as the test says.
class RawSlave {
 public:
  using Answer = std::function<void(int client, const Bytes& request)>;

  explicit RawSlave(Answer answer) : answer_(std::move(answer)) {
    listener_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof address;
    bind(listener_, reinterpret_cast<sockaddr*>(&address), length);
    listen(listener_, 4);
    getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &length);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  ~RawSlave() {
    shutdown(listener_, SHUT_RDWR);
    thread_.join();
    close(listener_);
  }
  RawSlave(const RawSlave&) = delete;
  RawSlave& operator=(const RawSlave&) = delete;
  std::uint16_t port() const { return port_; }

 private:
  void serve() {
    while (true) {
      const int client = accept(listener_, nullptr, nullptr);
      if (client < 0) return;
      Bytes request(300);
      while (true) {
        const ssize_t got = recv(client, request.data(), request.size(), 0);
        if (got <= 0) break;
        answer_(client, Bytes(request.begin(), request.begin() + got));
      }
      close(client);
    }
  }

  Answer answer_;
  int listener_ = -1;
  std::uint16_t port_ = 0;
  std::thread thread_;
};

void say(int client, const Bytes& bytes) {
  static_cast<void>(send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL));
}

// The right answer to FC 3 with two registers, to be spoilt.
Bytes right(const Bytes& request) {
  return {request[0], request[1], 0, 0, 0, 7, request[6], 3, 4, 0, 1, 0, 2};
}

Outcome ask(const RawSlave& slave, std::chrono::milliseconds timeout = 200ms) {
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
  // Transaction, function, byte count, and the count that goes with a longer frame.
  const std::vector<std::function<void(Bytes&)>> faults = {
      [](Bytes& bytes) { bytes[1] ^= 0x40; },
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
        bytes.resize(260);
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

TEST(HostileSlave, WhenTheAnswerDrips_ThenTheTimeoutHoldsForTheWhole) {
  RawSlave slave([](int client, const Bytes& request) {
    for (const std::uint8_t byte : right(request)) {
      say(client, {byte});
      std::this_thread::sleep_for(60ms);
    }
  });
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(ask(slave).fault, Fault::Timeout);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 600ms);  // byte by byte it would take 780 ms
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

// Under the sanitizers this is the proof that no answer can do harm in libmodbus.
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
