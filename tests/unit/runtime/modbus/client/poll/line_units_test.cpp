// Several units on one serial line, some of them silent or late. When each has its turn is a matter of the
// schedule (poll_schedule_test.cpp).

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

bool all_offline(RemoteIo& io, std::size_t first, std::size_t end) {
  for (std::size_t i = first; i < end; ++i) {
    if (io.status(i).online) return false;
  }
  return true;
}

bool good(RemoteIo& io, std::size_t device) {
  const DeviceStatus status = io.status(device);
  return status.online && status.tags[0].quality == Quality::Good;
}

TEST(LineUnits, WhenOneIsDead_ThenTheOthersAreReadAllTheSame) {
  LineOfUnits line;
  line.silence(3, true);
  RemoteIo io(units_on(line, 4));
  ASSERT_TRUE(wait_for([&] { return io.status(2).counters.timeouts >= 5; }));
  EXPECT_TRUE(wait_for([&] { return good(io, 0) && good(io, 1) && good(io, 3); }));
  EXPECT_TRUE(wait_for([&] { return io.in(1) == 1'010 && io.in(2) == 2'010 && io.in(4) == 4'010; }));
  EXPECT_FALSE(io.status(2).online);
  EXPECT_EQ(io.client->connections(), 1u);
}

TEST(LineUnits, WhenAllWereSilentAndAnswerAgain_ThenTheyAreBack) {
  LineOfUnits line;
  RemoteIo io(units_on(line, 6));
  ASSERT_TRUE(wait_for([&] { return all_online(io, 6); }));
  for (std::uint8_t unit = 1; unit <= 6; ++unit) line.silence(unit, true);
  ASSERT_TRUE(wait_for([&] { return all_offline(io, 0, 6); }));
  for (std::uint8_t unit = 1; unit <= 6; ++unit) line.silence(unit, false);
  ASSERT_TRUE(wait_for([&] { return all_online(io, 6); }));
}

TEST(LineUnits, WhenSeveralDieTogether_ThenTheOthersAreReadAllTheSame) {
  LineOfUnits line;
  RemoteIo io(units_on(line, 8));
  ASSERT_TRUE(wait_for([&] { return all_online(io, 8); }));
  for (std::uint8_t unit = 3; unit <= 8; ++unit) line.silence(unit, true);
  ASSERT_TRUE(wait_for([&] { return all_offline(io, 2, 8); }));
  EXPECT_TRUE(wait_for([&] { return good(io, 0) && good(io, 1); }));
}

// Every answer comes when its request was given up, and while its unit is left alone for as long again; both
// are longer than this process is ever held up. Two requests of one form: one could be taken for the other's.
TEST(LineUnits, WhenAUnitIsAlwaysLate_ThenNoValueIsThatOfAnotherRequest) {
  LineOfUnits line;
  std::vector<Device> devices = units_on(line, 2);
  devices[0].groups[0].inputs.push_back(word_tag(500, 3));
  devices[0].timeout = 2s;
  RemoteIo io(std::move(devices));
  ASSERT_TRUE(wait_for([&] { return all_online(io, 2); }));
  for (const auto delay : {2'100ms, 2'500ms}) {
    const auto missed = [&, before = io.status(0).counters.timeouts] {
      return io.status(0).counters.timeouts - before;
    };
    line.answer_after(1, delay);
    while (missed() < 3) {
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
