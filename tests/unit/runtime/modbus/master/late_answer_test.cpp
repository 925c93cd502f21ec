// Answers on a serial line that come after their time, where nothing says to which request they belong.

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <thread>

#include "runtime/modbus/master/master.h"
#include "tests/support/modbus_slave/line_of_units.h"
#include "tests/support/patience.h"

namespace stepwright::modbus::master {
namespace {

using namespace std::chrono_literals;
using support::LineOfUnits;

class LateAnswer : public ::testing::Test {
 protected:
  LateAnswer() : master(*Master::create(endpoint(), {.timeout = 100ms, .gap = 0us})) {
    EXPECT_TRUE(master.connect().good());
  }
  SerialEndpoint endpoint() const {
    return {.device = line.device(), .baud = 115'200, .parity = Parity::None};
  }
  Outcome read(std::uint8_t unit, std::uint16_t first) {
    EXPECT_TRUE(master.select_unit(unit).good());
    return master.read_registers(RegisterTable::Holding, first, words);
  }
  // The next request throws away what has not reached the line yet.
  void until_asked(std::uint8_t unit, int requests) const {
    const auto end = std::chrono::steady_clock::now() + support::kPatience;
    while (line.requests_of(unit) < requests && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(1ms);
    EXPECT_EQ(line.requests_of(unit), requests);
  }
  void times_out(std::uint8_t unit) {
    EXPECT_EQ(read(unit, 0).fault, Fault::Timeout);
    until_asked(unit, 1);
  }

  LineOfUnits line;
  Master master;
  std::array<std::uint16_t, 2> words{};
};

TEST_F(LateAnswer, WhenItIsThatOfAnotherUnit_ThenTheUnitThatWasAskedIsNotBlamed) {
  line.keep(1, 2);
  times_out(1);
  master.set_timeout(30s);
  ASSERT_TRUE(read(2, 5).good());  // within it the answer of unit 1 arrives
  EXPECT_EQ(words[0], 2'005);
  EXPECT_EQ(line.requests_of(2), 2);
}

TEST_F(LateAnswer, WhenItCameMeanwhile_ThenTheNextRequestDoesNotSeeIt) {
  line.keep(1);
  times_out(1);
  master.set_timeout(30s);
  EXPECT_TRUE(read(2, 0).good());
  line.release(1);
  ASSERT_TRUE(read(1, 500).good());
  EXPECT_EQ(words[0], 1'500);
  EXPECT_EQ(line.requests_of(1), 2);
}

// Three timeouts: of the request within which the other's answer came, of what might follow that, and of the
// request again.
TEST_F(LateAnswer, WhenTheUnitThatWasAskedIsSilent_ThenItIsAskedOnceMoreOnly) {
  line.keep(1, 2);
  line.silence(2, true);
  times_out(1);
  master.set_timeout(1s);
  EXPECT_EQ(read(2, 0).fault, Fault::Timeout);
  until_asked(2, 2);
}

// At 1200 baud 100 registers and their request are on the wire for 1.8 s.
TEST(SlowLine, WhenTheAnswerTakesLongerOnTheWireThanTheTimeout_ThenItIsWaitedFor) {
  LineOfUnits line;
  line.answer_after(1, 600ms);
  auto master = Master::create(SerialEndpoint{.device = line.device(), .baud = 1'200, .parity = Parity::None},
                               {.timeout = 50ms});
  ASSERT_TRUE(master);
  ASSERT_TRUE(master->connect().good());
  std::array<std::uint16_t, 100> words{};
  ASSERT_TRUE(master->read_registers(RegisterTable::Holding, 0, words).good());
  EXPECT_EQ(words[99], 1'099);
}

TEST(EchoingLine, WhenTheAdapterRepeatsWhatIsSent_ThenTheAnswerBehindItIsTaken) {
  LineOfUnits line;
  line.echo();
  for (const bool known : {true, false}) {
    auto master = Master::create(
        SerialEndpoint{.device = line.device(), .baud = 115'200, .parity = Parity::None, .echo = known},
        {.timeout = known ? 30s : 500ms});
    ASSERT_TRUE(master->connect().good());
    std::array<std::uint16_t, 2> words{};
    EXPECT_EQ(master->read_registers(RegisterTable::Holding, 5, words).good(), known);
    EXPECT_EQ(words[1], known ? 1'006 : 0);
  }
}

TEST(TimeOnLine, WhenCharactersAreSent_ThenEachTakesItsBits) {
  const SerialEndpoint line{.device = "x", .baud = 9'600};  // 8E1: 11 bits
  EXPECT_EQ(time_on(line, 96), 110'000us);
  EXPECT_EQ(time_on({.device = "x", .baud = 1'200, .parity = Parity::None}, 12), 100'000us);
}

}  // namespace
}  // namespace stepwright::modbus::master
