#include "tests/support/modbus_slave/line_of_units.h"

#include <poll.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "runtime/modbus/pdu/crc16.h"

namespace stepwright::support {
namespace {

using Clock = std::chrono::steady_clock;
using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kRequest = 8;
constexpr unsigned kOfUnit = 1'000;

struct Answer {
  Clock::time_point at;
  Bytes frame;

  std::uint8_t unit() const { return frame[0]; }
};

// Those of `from` for which `wanted` holds go to the end of `to`, due at once.
template <typename Wanted>
void move_answers(std::vector<Answer>& from, std::vector<Answer>& to, const Wanted& wanted) {
  for (const Answer& answer : from) {
    if (wanted(answer)) to.push_back({{}, answer.frame});
  }
  std::erase_if(from, wanted);
}

Bytes answer_to(const Bytes& request) {
  const auto first = static_cast<unsigned>(request[2] << 8 | request[3]);
  const auto count = static_cast<unsigned>(request[4] << 8 | request[5]);
  Bytes frame{request[0], 3, static_cast<std::uint8_t>(2 * count)};
  for (unsigned i = 0; i < count; ++i) {
    const unsigned value = kOfUnit * request[0] + first + i;
    frame.push_back(static_cast<std::uint8_t>(value >> 8));
    frame.push_back(static_cast<std::uint8_t>(value));
  }
  const std::uint16_t crc = modbus::pdu::crc16(std::as_bytes(std::span(frame)));
  frame.push_back(static_cast<std::uint8_t>(crc));
  frame.push_back(static_cast<std::uint8_t>(crc >> 8));
  return frame;
}

}  // namespace

LineOfUnits::LineOfUnits() {
  std::array<char, 128> name{};
  if (openpty(&ours_, &theirs_, name.data(), nullptr, nullptr) != 0) throw std::runtime_error("no pty");
  termios raw{};
  tcgetattr(theirs_, &raw);
  cfmakeraw(&raw);
  tcsetattr(theirs_, TCSANOW, &raw);
  device_ = name.data();
  thread_ = std::thread([this] { serve(); });
}

LineOfUnits::~LineOfUnits() {
  stop_ = true;
  thread_.join();
  close(ours_);
  close(theirs_);
}

void LineOfUnits::release(std::uint8_t unit) {
  keep_[unit] = false;
  released_ = unit;
  while (released_ >= 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

void LineOfUnits::serve() {
  Bytes received;
  std::vector<Answer> answers;
  std::vector<Answer> kept;
  while (!stop_) {
    pollfd entry{ours_, POLLIN, 0};
    if (poll(&entry, 1, 1) > 0) {
      std::array<std::uint8_t, 64> bytes{};
      const ssize_t got = read(ours_, bytes.data(), bytes.size());
      if (got > 0) received.insert(received.end(), bytes.begin(), bytes.begin() + got);
      if (got > 0 && echo_ && write(ours_, bytes.data(), static_cast<std::size_t>(got)) < 0) stop_ = true;
    }
    const auto now = Clock::now();
    if (received.size() >= kRequest) {
      const Bytes request(received.begin(), received.begin() + kRequest);
      received.clear();
      const std::uint8_t unit = request[0];
      ++requests_[unit];
      move_answers(kept, answers, [&](const Answer& answer) { return before_[answer.unit()] == unit; });
      if (!silent_[unit])
        (keep_[unit] ? kept : answers)
            .push_back({now + std::chrono::milliseconds(delay_ms_[unit]), answer_to(request)});
    }
    const int released = released_;
    move_answers(kept, answers, [&](const Answer& answer) { return answer.unit() == released; });
    for (const Answer& answer : answers) {
      if (answer.at > now) continue;
      if (write(ours_, answer.frame.data(), answer.frame.size()) < 0) stop_ = true;
    }
    std::erase_if(answers, [&](const Answer& answer) { return answer.at <= now; });
    if (released >= 0) released_ = -1;
  }
}

}  // namespace stepwright::support
