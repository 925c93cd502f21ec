#include "runtime/modbus/line/line_claim.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cerrno>

namespace stepwright::modbus::line {
namespace {

class Claim : public ::testing::Test {
 protected:
  Claim() {
    std::array<char, 128> name{};
    EXPECT_EQ(::openpty(&master, &slave, name.data(), nullptr, nullptr), 0);
    device = name.data();
  }
  ~Claim() override {
    ::close(master);
    ::close(slave);
  }
  // 9600 8E1, as libmodbus and our slave ask for it.
  termios even() const {
    termios settings{};
    ::tcgetattr(slave, &settings);
    ::cfmakeraw(&settings);
    settings.c_cflag |= PARENB | CREAD | CLOCAL;
    ::cfsetispeed(&settings, B9600);
    ::cfsetospeed(&settings, B9600);
    return settings;
  }

  int master = -1;
  int slave = -1;
  std::string device;
};

TEST_F(Claim, WhenItIsTaken_ThenNobodyElseGetsItUntilItIsReleased) {
  LineClaim first;
  ASSERT_EQ(first.take(device), 0);
  LineClaim second;
  EXPECT_EQ(second.take(device), EBUSY);
  EXPECT_EQ(lock(slave), EBUSY);
  first.release();
  EXPECT_EQ(second.take(device), 0);
}

TEST_F(Claim, WhenThereIsNoTerminal_ThenTheErrorSaysSo) {
  LineClaim claim;
  EXPECT_EQ(claim.take("/dev/no-such-line"), ENOENT);
  EXPECT_EQ(claim.take("/dev/null"), ENOTTY);
  EXPECT_EQ(claim.take(device), 0);
}

TEST_F(Claim, WhenAKilledProcessHasLeftItsSettings_ThenTheyCanBeSetAgain) {
  const termios settings = even();
  ASSERT_EQ(::tcsetattr(slave, TCSANOW, &settings), 0);
  LineClaim claim;
  ASSERT_EQ(claim.take(device), 0);
  EXPECT_EQ(::tcsetattr(slave, TCSANOW, &settings), 0);
  EXPECT_TRUE(has_taken(slave, settings));
}

TEST_F(Claim, WhenTheSpeedIsAnother_ThenTheSettingsAreNotTaken) {
  termios settings = even();
  ASSERT_EQ(::tcsetattr(slave, TCSANOW, &settings), 0);
  EXPECT_TRUE(has_taken(slave, settings));
  ::cfsetospeed(&settings, B19200);
  EXPECT_FALSE(has_taken(slave, settings));
}

TEST_F(Claim, WhenItIsAPseudoTerminal_ThenItStaysOpenToAll) {
  EXPECT_TRUE(is_pseudo_terminal(slave));
  keep_others_out(slave);
  int exclusive = 1;
  ASSERT_EQ(::ioctl(slave, TIOCGEXCL, &exclusive), 0);
  EXPECT_EQ(exclusive, 0);
  const int null = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  EXPECT_FALSE(is_pseudo_terminal(null));
  ::close(null);
}

}  // namespace
}  // namespace stepwright::modbus::line
