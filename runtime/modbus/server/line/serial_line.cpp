#include "runtime/modbus/server/line/serial_line.h"

#include <fcntl.h>
#include <linux/serial.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <utility>

#include "runtime/modbus/line/line_claim.h"

namespace stepwright::modbus::server {

namespace {

using result::fail;

struct Speed {
  std::uint32_t baud;
  speed_t code;
};

constexpr std::array kSpeeds{Speed{1'200, B1200},     Speed{2'400, B2400},     Speed{4'800, B4800},
                             Speed{9'600, B9600},     Speed{19'200, B19200},   Speed{38'400, B38400},
                             Speed{57'600, B57600},   Speed{115'200, B115200}, Speed{230'400, B230400},
                             Speed{460'800, B460800}, Speed{921'600, B921600}};

constexpr auto kBauds = [] {
  std::array<std::uint32_t, kSpeeds.size()> bauds{};
  for (std::size_t i = 0; i < bauds.size(); ++i) bauds[i] = kSpeeds[i].baud;
  return bauds;
}();

std::optional<speed_t> code_of(std::uint32_t baud) {
  const auto found = std::ranges::find(kSpeeds, baud, &Speed::baud);
  if (found == kSpeeds.end()) return std::nullopt;
  return found->code;
}

std::string reason() {
  return std::strerror(errno);
}

// Raw, 8 data bits, no handshake. A byte with a wrong parity reads as 0, which the frame's CRC finds.
void apply(const LineOptions& options, speed_t speed, termios& settings) {
  ::cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(CRTSCTS | PARENB | PARODD | CSTOPB);
  if (options.parity != Parity::None) {
    settings.c_cflag |= PARENB;
    settings.c_iflag |= INPCK;
  }
  if (options.parity == Parity::Odd) settings.c_cflag |= PARODD;
  if (options.stop_bits == 2) settings.c_cflag |= CSTOPB;
  settings.c_cc[VMIN] = 1;  // else the end of the line and a pause would read alike
  settings.c_cc[VTIME] = 0;
  ::cfsetispeed(&settings, speed);
  ::cfsetospeed(&settings, speed);
}

bool switch_to_rs485(int descriptor) {
  serial_rs485 settings{};
  settings.flags = SER_RS485_ENABLED | SER_RS485_RTS_ON_SEND;
  return ::ioctl(descriptor, TIOCSRS485, &settings) == 0;
}

tl::unexpected<result::Diagnostics> in_use(const LineOptions& options) {
  return fail("R0112", options.where,
              "the serial line " + options.device.string() + " is in use by another process",
              "a line has one slave process; a master needs a line of its own");
}

Moved moved(ssize_t count) {
  if (count > 0) return {Moved::State::Done, static_cast<std::size_t>(count)};
  const bool later = count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR);
  return {later ? Moved::State::WouldBlock : Moved::State::Closed, 0};
}

}  // namespace

std::span<const std::uint32_t> line_speeds() {
  return kBauds;
}

std::string line_text(const LineOptions& options) {
  const char parity = options.parity == Parity::None ? 'N' : options.parity == Parity::Even ? 'E' : 'O';
  return std::to_string(options.baud) + " 8" + parity + std::to_string(options.stop_bits);
}

result::Result<SerialLine> SerialLine::open(const LineOptions& options) {
  const std::string device = options.device.string();
  const auto speed = code_of(options.baud);
  if (!speed || options.stop_bits < 1 || options.stop_bits > 2)
    return fail("R0113", options.where, "a serial line cannot have " + line_text(options),
                "speeds are 1200 to 921600 baud in the usual steps, stop bits 1 or 2");
  SerialLine line(::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (line.descriptor_ < 0 && errno == EBUSY) return in_use(options);
  if (line.descriptor_ < 0)
    return fail("R0111", options.where, "cannot open the serial line " + device + ": " + reason(),
                errno == EACCES
                    ? "the process's user must be in the group of the device, often dialout"
                    : "is the adapter plugged in? /dev/serial/by-id has names that do not change");
  termios settings{};
  if (::tcgetattr(line.descriptor_, &settings) != 0)
    return fail("R0111", options.where, device + " is no serial line", "");
  if (line::lock(line.descriptor_) != 0) return in_use(options);
  apply(options, *speed, settings);
  // Its word is not relied on: it is content with a part, and refuses a pseudo terminal what it has already.
  ::tcsetattr(line.descriptor_, TCSANOW, &settings);
  if (!line::has_taken(line.descriptor_, settings))
    return fail("R0113", options.where, device + " does not take " + line_text(options),
                "choose another speed, or what the adapter can do");
  if (options.rs485 && !switch_to_rs485(line.descriptor_))
    return fail("R0113", options.where, device + " cannot switch an RS-485 transmitter: " + reason(),
                "set rs485 = false where the adapter does it by itself, as those on USB do");
  line::keep_others_out(line.descriptor_);
  line::ask_for_low_latency(line.descriptor_);
  ::tcflush(line.descriptor_, TCIOFLUSH);
  return line;
}

SerialLine::SerialLine(SerialLine&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

SerialLine::~SerialLine() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Moved SerialLine::read(std::span<std::byte> into) {
  return moved(::read(descriptor_, into.data(), into.size()));
}

Moved SerialLine::write(std::span<const std::byte> from) {
  return moved(::write(descriptor_, from.data(), from.size()));
}

}  // namespace stepwright::modbus::server
