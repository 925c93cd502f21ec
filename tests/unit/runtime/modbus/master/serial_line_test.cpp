// The master on a serial line: a pair of ptys of socat, a slave of libmodbus at the other end.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <filesystem>
#include <thread>

#include "runtime/modbus/master/master.h"
#include "tests/support/modbus_slave/modbus_slave.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_process.h"

namespace stepwright::modbus::master {
namespace {

using namespace std::chrono_literals;
using support::ModbusSlave;

class SerialLine : public ::testing::Test {
 protected:
  void SetUp() override { start_socat(); }
  void start_socat() {
    socat_ = std::make_unique<support::TestProcess>(
        std::vector<std::string>{"/usr/bin/socat", "pty,raw,echo=0,link=" + end("a"),
                                 "pty,raw,echo=0,link=" + end("b")},
        folder_ / "socat.log");
    for (int i = 0; i < 6'000 && !std::filesystem::exists(end("b")); ++i) std::this_thread::sleep_for(10ms);
    ASSERT_TRUE(std::filesystem::exists(end("b")));
  }
  void TearDown() override { socat_.reset(); }
  std::string end(const char* name) const { return (folder_ / name).string(); }
  Master master(std::chrono::milliseconds timeout = 30s) const {
    auto made = Master::create(SerialEndpoint{.device = end("a")}, {.timeout = timeout});
    EXPECT_TRUE(made);
    return std::move(*made);
  }
  // Bytes have come to the master's end that nobody has read.
  bool something_waits() const {
    const int descriptor = ::open(end("a").c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    int bytes = 0;
    for (int i = 0; i < 6'000 && bytes == 0; ++i) {
      ::ioctl(descriptor, FIONREAD, &bytes);
      std::this_thread::sleep_for(10ms);
    }
    ::close(descriptor);
    return bytes > 0;
  }

  support::TemporaryFolder folder_;
  std::unique_ptr<support::TestProcess> socat_;
};

TEST_F(SerialLine, WhenASlaveIsThere_ThenItAnswersAndOtherUnitsDoNot) {
  ModbusSlave slave({.device = end("b"), .unit = 5});
  slave.set_holding(10, 1'234);
  Master line = master();
  ASSERT_TRUE(line.connect().good());
  std::array<std::uint16_t, 2> words{};
  ASSERT_TRUE(line.select_unit(5).good());
  ASSERT_TRUE(line.read_registers(RegisterTable::Holding, 10, words).good());
  EXPECT_EQ(words[0], 1'234);
  EXPECT_TRUE(line.write_registers(20, words).good());
  EXPECT_EQ(slave.holding(20), 1'234);
  line.set_timeout(100ms);
  ASSERT_TRUE(line.select_unit(6).good());
  EXPECT_EQ(line.read_registers(RegisterTable::Holding, 10, words).fault, Fault::Timeout);
  // A slave of libmodbus takes what follows a request to another unit for that unit's answer, for half a
  // second.
  ASSERT_TRUE(line.select_unit(5).good());
  line.set_timeout(600ms);
  Outcome outcome{Fault::Timeout, 0, 0};
  for (int i = 0; i < 100 && !outcome.good(); ++i)
    outcome = line.read_registers(RegisterTable::Holding, 10, words);
  EXPECT_TRUE(outcome.good());
  EXPECT_EQ(line.select_unit(0).fault, Fault::BadRequest);
}

TEST_F(SerialLine, WhenNoiseIsOnTheLine_ThenItIsThrownAway) {
  ModbusSlave slave({.device = end("b")});
  Master line = master();
  ASSERT_TRUE(line.connect().good());
  slave.silence(1, true);
  std::array<std::uint16_t, 1> word{};
  line.set_timeout(50ms);
  EXPECT_EQ(line.read_registers(RegisterTable::Holding, 0, word).fault, Fault::Timeout);
  for (int i = 0; i < 6'000 && slave.requests() < 1; ++i) std::this_thread::sleep_for(10ms);
  ASSERT_EQ(slave.requests(), 1) << "a slow slave would answer it later on";
  slave.silence(1, false);
  slave.answer_after_ms(100);
  EXPECT_EQ(line.read_registers(RegisterTable::Holding, 0, word).fault, Fault::Timeout);
  ASSERT_TRUE(something_waits()) << "the late answer is on the line";
  slave.answer_after_ms(0);
  slave.set_holding(1, 9);
  line.set_timeout(30s);
  ASSERT_TRUE(line.read_registers(RegisterTable::Holding, 1, word).good());
  EXPECT_EQ(word[0], 9);
}

TEST_F(SerialLine, WhenTheDeviceGoes_ThenTheConnectionIsLostUntilItIsBack) {
  Master line = master();
  {
    ModbusSlave slave({.device = end("b")});
    ASSERT_TRUE(line.connect().good());
    EXPECT_TRUE(line.write_register(0, 1).good());
  }
  socat_->kill();
  EXPECT_FALSE(line.write_register(0, 1).good());
  EXPECT_FALSE(line.connect().good());
  std::filesystem::remove(end("a"));
  std::filesystem::remove(end("b"));
  start_socat();
  ModbusSlave slave({.device = end("b")});
  ASSERT_TRUE(line.connect().good());
  EXPECT_TRUE(line.write_register(0, 1).good());
}

TEST_F(SerialLine, WhenAnotherMasterHasIt_ThenItIsRefusedUntilThatOneLeaves) {
  Master first = master();
  ASSERT_TRUE(first.connect().good());
  Master second = master();
  const Outcome refused = second.connect();
  EXPECT_EQ(refused.fault, Fault::NotConnected);
  EXPECT_NE(refused.text().find("in use"), std::string::npos) << refused.text();
  // The same device under another name.
  std::filesystem::create_symlink(end("a"), end("c"));
  auto alias = Master::create(SerialEndpoint{.device = end("c")}, {});
  ASSERT_TRUE(alias);
  EXPECT_EQ(alias->connect().fault, Fault::NotConnected);
  first.close();
  EXPECT_TRUE(second.connect().good());
}

TEST_F(SerialLine, WhenItIsNoTerminal_ThenThereIsNoConnection) {
  auto made = Master::create(SerialEndpoint{.device = "/dev/null"}, {});
  ASSERT_TRUE(made);
  EXPECT_EQ(made->connect().fault, Fault::NotConnected);
}

}  // namespace
}  // namespace stepwright::modbus::master
