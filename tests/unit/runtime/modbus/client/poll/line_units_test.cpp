// Several units on one serial line: what a dead one costs the others, and how it and the line come back.

#include <algorithm>

#include "runtime/modbus/client/poll/unit.h"
#include "tests/support/modbus_slave/line_of_units.h"
#include "tests/unit/runtime/modbus/client/poll/remote_io.h"

namespace stepwright::modbus::client {
namespace {

using support::LineOfUnits;

constexpr auto kTimeout = 100ms;

std::vector<Device> units_on(const LineOfUnits& line, int count) {
  std::vector<Device> devices;
  for (int i = 1; i <= count; ++i) {
    devices.push_back(device_at(0, {group_of({word_tag(10, static_cast<std::uint32_t>(i))}, {}, 50ms)},
                                static_cast<std::uint8_t>(i)));
    devices.back().endpoint =
        master::SerialEndpoint{.device = line.device(), .baud = 115'200, .parity = master::Parity::None};
    devices.back().gap = 0us;
    devices.back().timeout = kTimeout;
    devices.back().retry_after = 200ms;
    devices.back().retry_at_most = 1'600ms;
  }
  return devices;
}

bool all_online(RemoteIo& io, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (!io.status(i).online) return false;
  }
  return true;
}

TEST(LineUnits, WhenOneIsDead_ThenItsTriesBecomeRareAndTheOthersStayGood) {
  LineOfUnits line;
  line.silence(3, true);
  RemoteIo io(units_on(line, 4));
  ASSERT_TRUE(wait_for([&] { return io.status(0).online && io.status(2).counters.timeouts >= 5; }));
  const auto before = io.status(2).counters.timeouts;
  const int asked = line.requests_of(1);
  std::int64_t oldest = 0;
  ASSERT_TRUE(wait_for([&] {
    for (const std::size_t i : {0u, 1u, 3u}) {
      EXPECT_TRUE(io.status(i).online);
      oldest = std::max(oldest, io.status(i).tags[0].age_ms);
    }
    return io.status(2).counters.timeouts >= before + 2;
  }));
  std::printf("values of the others were %lld ms old at most\n", static_cast<long long>(oldest));
  // A try each 1.6 s now, which are 16 periods of the others; at first it was one each 0.3 s.
  EXPECT_GE(line.requests_of(1) - asked, 10);
  EXPECT_TRUE(wait_for([&] { return io.status(0).tags[0].quality == Quality::Good; }));
  EXPECT_EQ(io.client->connections(), 1u);
  EXPECT_EQ(io.in(1), 1'010u);
  EXPECT_EQ(io.in(4), 4'010u);
}

TEST(LineUnits, WhenAllWereSilentAndOneAnswers_ThenTheOthersAreTriedAtOnce) {
  LineOfUnits line;
  RemoteIo io(units_on(line, 6));
  ASSERT_TRUE(wait_for([&] { return all_online(io, 6); }));
  for (std::uint8_t unit = 1; unit <= 6; ++unit) line.silence(unit, true);
  ASSERT_TRUE(wait_for([&] {
    for (std::size_t i = 0; i < 6; ++i) {
      if (io.status(i).online) return false;
    }
    return true;
  }));
  std::this_thread::sleep_for(3s);  // long enough for the longest pauses
  for (std::uint8_t unit = 1; unit <= 6; ++unit) line.silence(unit, false);
  const auto begin = Clock::now();
  ASSERT_TRUE(wait_for([&] { return all_online(io, 6); }));
  std::printf("6 units of a line that was silent are back after %.0f ms\n", ms_since(begin));
  EXPECT_LT(ms_since(begin), 1'500.0);
}

TEST(LineUnits, WhenSeveralDieTogether_ThenTheOthersHaveTurnsBetweenTheirTimeouts) {
  LineOfUnits line;
  RemoteIo io(units_on(line, 8));
  ASSERT_TRUE(wait_for([&] { return all_online(io, 8); }));
  for (std::uint8_t unit = 3; unit <= 8; ++unit) line.silence(unit, true);
  const int tried = line.requests_of(1);
  ASSERT_TRUE(wait_for([&] {
    for (std::size_t i = 2; i < 8; ++i) {
      if (io.status(i).online) return false;
    }
    return true;
  }));
  // Each of the 6 was silent twice: 12 timeouts. Their second tries come after the others' turns.
  EXPECT_GE(line.requests_of(1) - tried, 6);
  EXPECT_TRUE(io.status(0).online);
  EXPECT_TRUE(io.status(1).online);
}

// Every answer comes when its request was given up. Two requests of one form, so that one could be taken for
// the other's.
TEST(LineUnits, WhenAUnitIsAlwaysLate_ThenNoValueIsThatOfAnotherRequest) {
  LineOfUnits line;
  std::vector<Device> devices = units_on(line, 2);
  devices[0].groups[0].inputs.push_back(word_tag(500, 3));
  RemoteIo io(std::move(devices));
  ASSERT_TRUE(wait_for([&] { return all_online(io, 2); }));
  for (const auto delay : {110ms, 130ms, 180ms}) {
    line.answer_after(1, delay);
    for (const auto begin = Clock::now(); ms_since(begin) < 1'500.0;) {
      ASSERT_EQ(io.in(1), 1'010u) << delay.count();
      ASSERT_EQ(io.in(3), 1'500u) << delay.count();
      std::this_thread::sleep_for(1ms);
    }
    // The other one is heard all the while; a busy machine may keep it waiting now and then.
    ASSERT_TRUE(wait_for([&] { return io.status(1).tags[0].quality == Quality::Good; })) << delay.count();
    line.answer_after(1, 0ms);
    ASSERT_TRUE(wait_for([&] { return all_online(io, 2); }));
  }
}

TEST(LineUnits, WhenTheyWantDifferentSettings_ThenTheLineIsRefused) {
  LineOfUnits line;
  ClientSettings settings;
  settings.devices = units_on(line, 2);
  std::get<master::SerialEndpoint>(settings.devices[1].endpoint).baud = 9'600;
  const auto made = IoClient::create(settings);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error()[0].code, "R0126");
  settings.devices[1].endpoint = settings.devices[0].endpoint;
  settings.devices[1].gap = 5ms;
  EXPECT_FALSE(IoClient::create(settings));
}

TEST(Unit, WhenItStaysSilent_ThenItsPausesDoubleWhileOthersAnswer) {
  Device device = device_at(1, {group_of({word_tag(0, 0)})});
  device.retries = 1;
  device.retry_after = 500ms;
  device.retry_at_most = 1'500ms;
  const Clock::time_point start{};
  Unit unit(device, start);
  EXPECT_FALSE(unit.silent(start, true));
  EXPECT_TRUE(unit.doubtful());
  EXPECT_TRUE(unit.silent(start, true));
  EXPECT_EQ(unit.wakes_at(), start + 500ms);
  EXPECT_TRUE(unit.silent(start, true));
  EXPECT_EQ(unit.wakes_at(), start + 1'000ms);
  EXPECT_TRUE(unit.silent(start, true));
  EXPECT_EQ(unit.wakes_at(), start + 1'500ms);
  EXPECT_TRUE(unit.silent(start, false));
  EXPECT_EQ(unit.wakes_at(), start + 500ms) << "nobody is left whom it would delay";
  unit.hope(start + 100ms);
  EXPECT_EQ(unit.wakes_at(), start + 100ms);
  unit.answered();
  EXPECT_FALSE(unit.asleep());
  EXPECT_FALSE(unit.doubtful());
}

}  // namespace
}  // namespace stepwright::modbus::client
