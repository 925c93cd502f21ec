#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <string>
#include <vector>

#include "runtime/modbus/server/line/line_acceptor.h"
#include "tests/support/patience.h"
#include "tests/unit/runtime/modbus/server/line/pty.h"

namespace stepwright::modbus::server {
namespace {

using std::chrono::milliseconds;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr milliseconds kRetry{20};
constexpr int kPatienceMs = std::chrono::milliseconds(support::kPatience).count();

LineOptions options_of(const Pty& pty) {
  LineOptions out;
  out.device = pty.device;
  out.parity = Parity::None;
  out.stop_bits = 2;
  return out;
}

std::string error_of(const LineOptions& options) {
  const auto line = SerialLine::open(options);
  return line ? "" : result::to_string(line.error());
}

bool is_readable(int descriptor, int patience_ms) {
  pollfd entry{descriptor, POLLIN, 0};
  return ::poll(&entry, 1, patience_ms) == 1;
}

std::string read_all(Transport& transport) {
  std::string out;
  std::array<std::byte, 64> buffer;
  if (!is_readable(transport.descriptor(), kPatienceMs)) return out;
  for (Moved moved = transport.read(buffer); moved.state == Moved::State::Done;
       moved = transport.read(buffer)) {
    for (std::size_t i = 0; i < moved.bytes; ++i) out += static_cast<char>(buffer[i]);
  }
  return out;
}

TEST(SerialLine, Bytes_WhenAnyAreSent_ThenArriveAsTheyAre) {
  const Pty pty;
  const auto acceptor = LineAcceptor::create(options_of(pty), nullptr, kRetry);
  ASSERT_TRUE(is_readable(acceptor->descriptor(), kPatienceMs));
  const auto line = acceptor->admit();
  ASSERT_NE(line, nullptr);
  std::string all;
  for (int i = 0; i < 256; ++i)
    all += static_cast<char>(i);  // with XON, XOFF, CR and the interrupt character
  ASSERT_EQ(::write(pty.master, all.data(), all.size()), 256);
  std::string got;
  while (got.size() < all.size()) {
    const std::string more = read_all(*line);
    if (more.empty()) break;
    got += more;
  }
  EXPECT_EQ(got, all);
  EXPECT_EQ(line->write(std::as_bytes(std::span(all))).bytes, 256u);
  std::array<char, 300> back{};
  ASSERT_TRUE(is_readable(pty.master, kPatienceMs));
  EXPECT_EQ(std::string(back.data(), static_cast<std::size_t>(
                                         std::max<ssize_t>(0, ::read(pty.master, back.data(), back.size())))),
            all);
  EXPECT_EQ(line->framing(), Framing::Rtu);
  EXPECT_EQ(line->peer()->address, pty.device);
}

TEST(SerialLine, Read_WhenNothingCame_ThenWouldBlockAndWhenTheDeviceIsGoneThenClosed) {
  Pty pty;
  auto line = SerialLine::open(options_of(pty));
  ASSERT_TRUE(line);
  std::array<std::byte, 8> buffer;
  EXPECT_EQ(line->read(buffer).state, Moved::State::WouldBlock);
  pty.close();
  EXPECT_EQ(line->read(buffer).state, Moved::State::Closed);
}

TEST(SerialLine, Settings_WhenOpened_ThenAreThoseOfTheOptions) {
  const Pty pty;
  LineOptions options = options_of(pty);
  options.baud = 115'200;
  const auto line = SerialLine::open(options);
  ASSERT_TRUE(line);
  termios settings{};
  ASSERT_EQ(::tcgetattr(pty.slave, &settings), 0);
  EXPECT_EQ(::cfgetospeed(&settings), static_cast<speed_t>(B115200));
  EXPECT_NE(settings.c_cflag & CSTOPB, 0u);
  EXPECT_EQ(settings.c_cflag & CSIZE, static_cast<tcflag_t>(CS8));
  EXPECT_EQ(settings.c_lflag & (ICANON | ECHO | ISIG), 0u);
}

TEST(SerialLine, Open_WhenAProcessThatIsGoneHasLeftTheSameSettings_ThenTheyAreSetAgain) {
  const Pty pty;
  LineOptions options = options_of(pty);
  options.parity = Parity::Even;
  options.stop_bits = 1;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(error_of(options), "");
}

TEST(SerialLine, Open_WhenItCannotBe_ThenDiagnosticsSayWhy) {
  const Pty pty;
  LineOptions options = options_of(pty);
  options.device = "/dev/no-such-line";
  EXPECT_THAT(error_of(options), AllOf(HasSubstr("R0111"), HasSubstr("/dev/no-such-line")));
  options.device = "/dev/null";
  EXPECT_THAT(error_of(options), AllOf(HasSubstr("R0111"), HasSubstr("no serial line")));
  options = options_of(pty);
  options.baud = 12'345;
  EXPECT_THAT(error_of(options), AllOf(HasSubstr("R0113"), HasSubstr("12345 8N2")));
  options = options_of(pty);
  options.rs485 = true;
  EXPECT_THAT(error_of(options), AllOf(HasSubstr("R0113"), HasSubstr("rs485 = false")));
  const auto first = SerialLine::open(options_of(pty));
  ASSERT_TRUE(first);
  EXPECT_THAT(error_of(options_of(pty)), HasSubstr("R0112"));
}

TEST(LineAcceptor, Line_WhenItIsMissing_ThenIsTriedAgainAndTroubleToldOnce) {
  LineOptions options;
  options.device = "/dev/no-such-line";
  std::vector<std::string> troubles;
  const auto acceptor = LineAcceptor::create(
      options, [&](const auto& why) { troubles.push_back(result::to_string(why)); }, kRetry);
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(is_readable(acceptor->descriptor(), kPatienceMs));
    EXPECT_EQ(acceptor->admit(), nullptr);
    EXPECT_FALSE(is_readable(acceptor->descriptor(), 0)) << "the acceptor must wait before it tries again";
  }
  EXPECT_THAT(troubles, ElementsAre(HasSubstr("R0111")));
}

TEST(LineAcceptor, Line_WhenItWasLost_ThenIsOpenedAgain) {
  const Pty pty;
  const auto acceptor = LineAcceptor::create(options_of(pty), nullptr, kRetry);
  ASSERT_TRUE(is_readable(acceptor->descriptor(), kPatienceMs));
  auto line = acceptor->admit();
  ASSERT_NE(line, nullptr);
  EXPECT_FALSE(is_readable(acceptor->descriptor(), 3 * static_cast<int>(kRetry.count())))
      << "there is one line only";
  line.reset();
  ASSERT_TRUE(is_readable(acceptor->descriptor(), kPatienceMs));
  EXPECT_NE(acceptor->admit(), nullptr);
}

TEST(LineAcceptor, Line_WhenTurnedAway_ThenTheDescriptorRests) {
  const Pty pty;
  const auto acceptor = LineAcceptor::create(options_of(pty), nullptr, kRetry);
  ASSERT_TRUE(is_readable(acceptor->descriptor(), kPatienceMs));
  acceptor->turn_away();
  EXPECT_FALSE(is_readable(acceptor->descriptor(), 0));
  EXPECT_TRUE(is_readable(acceptor->descriptor(), kPatienceMs));
  EXPECT_EQ(acceptor->name(), "rtu " + pty.device + " 19200 8N2 unit 1");
}

}  // namespace
}  // namespace stepwright::modbus::server
