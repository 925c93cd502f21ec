// Devices that end a connection after an answer: they are read and written at their own pace, and not asked
// as fast as the network carries.

#include <atomic>

#include "tests/support/modbus_slave/raw_slave.h"
#include "tests/unit/runtime/modbus/client/poll/remote_io.h"

namespace stepwright::modbus::client {
namespace {

using support::RawSlave;
using support::say;
using Bytes = RawSlave::Bytes;

constexpr std::uint8_t kRead = 3;

std::uint16_t word(const Bytes& bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] << 8 | bytes[at + 1]);
}

// Each register holds its own address and a write is repeated.
Bytes answer_to(const Bytes& request) {
  if (request[7] != kRead) {
    Bytes repeated(request.begin(), request.begin() + 12);
    repeated[5] = 6;
    return repeated;
  }
  const std::uint16_t first = word(request, 8);
  const std::uint16_t count = word(request, 10);
  Bytes bytes = {request[0], request[1], 0,
                 0,          0,          static_cast<std::uint8_t>(3 + 2 * count),
                 request[6], kRead,      static_cast<std::uint8_t>(2 * count)};
  for (std::uint16_t i = 0; i < count; ++i) {
    bytes.push_back(static_cast<std::uint8_t>((first + i) >> 8));
    bytes.push_back(static_cast<std::uint8_t>(first + i));
  }
  return bytes;
}

// Two reads that no gap joins, and two writes.
Device device(std::uint16_t port) {
  return device_at(port,
                   {group_of({word_tag(100, 0), word_tag(900, 1)}, {word_tag(20, 0), word_tag(40, 1)})});
}

struct ClosingSlave {
  std::atomic<bool> wrote_20{false};
  std::atomic<bool> wrote_40{false};
  RawSlave slave{[this](int client, const Bytes& request) {
    if (request[7] != kRead) (word(request, 8) == 20 ? wrote_20 : wrote_40) = true;
    say(client, answer_to(request));
    shutdown(client, SHUT_RDWR);
  }};
};

void expect_all_carried(ClosingSlave& closing, RemoteIo& io) {
  EXPECT_TRUE(wait_for([&] { return io.in(0) == 100 && io.in(1) == 900; }));
  EXPECT_TRUE(wait_for([&] { return closing.wrote_20 && closing.wrote_40; }));
}

TEST(ClosingSlave, WhenItIsKnownToClose_ThenItsConnectionsAreNotCountedAsLost) {
  ClosingSlave closing;
  Device known = device(closing.slave.port());
  known.requests_per_connection = 1;
  RemoteIo io({known});
  io.out(0, 1);
  io.out(1, 2);
  expect_all_carried(closing, io);
  EXPECT_TRUE(wait_for([&] { return closing.slave.requests() >= 40; }));
  EXPECT_EQ(io.status().counters.connection_losses, 0u);
  EXPECT_EQ(io.status().counters.requests, io.status().counters.answer.count());
}

TEST(ClosingSlave, WhenItWantsPauses_ThenItHasThem) {
  ClosingSlave closing;
  Device known = device(closing.slave.port());
  known.requests_per_connection = 1;
  known.pause = 50ms;
  const auto begin = Clock::now();
  RemoteIo io({known});
  EXPECT_TRUE(wait_for([&] { return closing.slave.connections() >= 9; }));
  EXPECT_GE(ms_since(begin), 8 * 50.0 - 5.0);
}

// Nobody has said so: everything is carried all the same, on 50 connections a second at most.
TEST(ClosingSlave, WhenNobodyKnows_ThenAllIsCarriedWithoutHaste) {
  ClosingSlave closing;
  const auto begin = Clock::now();
  RemoteIo io({device(closing.slave.port())});
  io.out(0, 1);
  io.out(1, 2);
  expect_all_carried(closing, io);
  EXPECT_TRUE(wait_for([&] { return closing.slave.connections() >= 20; }));
  EXPECT_LE(closing.slave.connections(), 2 + static_cast<int>(ms_since(begin) / 20.0));
  EXPECT_FALSE(io.client->lost());
}

// It accepts and closes at once, or answers nonsense: the pauses grow.
TEST(ClosingSlave, WhenItNeverAnswersRightly_ThenThePausesGrow) {
  RawSlave slave([](int client, const Bytes& request) {
    say(client, request);
    say(client, request);
  });
  const auto begin = Clock::now();
  RemoteIo io({device(slave.port())});
  EXPECT_TRUE(wait_for([&] { return slave.connections() >= 6; }));
  EXPECT_GE(ms_since(begin), 20.0 + 40.0 + 80.0);
  EXPECT_TRUE(wait_for([&] { return io.client->lost(); }));
}

}  // namespace
}  // namespace stepwright::modbus::client
