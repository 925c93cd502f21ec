#include "runtime/modbus/master/exchange.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include "runtime/modbus/pdu/crc16.h"
#include "runtime/modbus/pdu/tcp_frame.h"

namespace stepwright::modbus::master {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kUnit = 1;
constexpr std::size_t kCrc = 2;
constexpr std::uint16_t kMostUnanswered = 100;

Outcome fault(Fault kind, int error = 0) {
  return {kind, 0, error};
}

// 0: ready; otherwise errno, ETIMEDOUT after `end`.
int wait_for(int descriptor, short events, Clock::time_point end) {
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd entry{descriptor, events, 0};
    const int ready = poll(&entry, 1, static_cast<int>(std::max<std::int64_t>(left, 0)));
    if (ready > 0) return 0;
    if (ready == 0) return ETIMEDOUT;
    if (errno != EINTR) return errno;
  }
}

int send_all(int descriptor, std::span<const std::byte> bytes, Clock::time_point end) {
  while (!bytes.empty()) {
    if (const int error = wait_for(descriptor, POLLOUT, end); error != 0) return error;
    ssize_t sent = ::send(descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && errno == ENOTSOCK) sent = ::write(descriptor, bytes.data(), bytes.size());
    if (sent < 0 && errno != EAGAIN && errno != EINTR) return errno;
    if (sent > 0) bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
  return 0;
}

// Adds what there is to `held` bytes of `room`; 0, or errno.
int receive_more(int descriptor, std::span<std::byte> room, std::size_t& held, Clock::time_point end) {
  while (true) {
    if (const int error = wait_for(descriptor, POLLIN, end); error != 0) return error;
    const ssize_t got = ::read(descriptor, room.data() + held, room.size() - held);
    if (got > 0) {
      held += static_cast<std::size_t>(got);
      return 0;
    }
    if (got == 0) return ECONNRESET;
    if (errno != EAGAIN && errno != EINTR) return errno;
  }
}

Outcome not_received(int error) {
  return fault(error == ETIMEDOUT ? Fault::Timeout : Fault::ConnectionLost, error);
}

Answer judged(const WireRequest& request, std::span<const std::byte> pdu) {
  if (const auto exception = request.exception(pdu)) return {{Fault::Exception, *exception, 0}, {}};
  if (!request.fits(pdu)) return {fault(Fault::BadAnswer), {}};
  return {{}, pdu};
}

}  // namespace

Answer Exchange::ask(int descriptor, std::uint8_t unit, const WireRequest& request,
                     std::chrono::milliseconds timeout, std::span<std::byte> room) {
  const auto end = Clock::now() + timeout;
  std::array<std::byte, pdu::kMaxTcpFrame> frame;
  const std::size_t size = framed(unit, request, frame);
  if (const int error = send_all(descriptor, std::span(frame).first(size), end); error != 0)
    return {not_received(error), {}};
  if (options_.framing == Framing::Tcp) {
    Answer answer = receive_tcp(descriptor, unit, request, end, room);
    const bool silent = answer.outcome.fault == Fault::Timeout;
    unanswered_ = silent ? std::min<std::uint16_t>(unanswered_ + 1, kMostUnanswered) : 0;
    return answer;
  }
  if (options_.echo) {
    std::size_t held = 0;
    while (held < size) {
      if (const int error = receive_more(descriptor, room.first(size), held, end); error != 0)
        return {not_received(error), {}};
    }
    if (!std::ranges::equal(room.first(size), std::span(frame).first(size)))
      return {fault(Fault::BadAnswer), {}};
  }
  return receive_rtu(descriptor, unit, request, end, room);
}

std::size_t Exchange::framed(std::uint8_t unit, const WireRequest& request, std::span<std::byte> out) {
  const auto pdu = request.pdu();
  if (options_.framing == Framing::Tcp) {
    std::ranges::copy(pdu, pdu::tcp_pdu(out).begin());
    return pdu::seal_tcp(out, ++transaction_, unit, pdu.size());
  }
  out[0] = static_cast<std::byte>(unit);
  std::ranges::copy(pdu, out.begin() + kUnit);
  const std::uint16_t crc = pdu::crc16(out.first(kUnit + pdu.size()));
  out[kUnit + pdu.size()] = static_cast<std::byte>(crc & 0xFF);
  out[kUnit + pdu.size() + 1] = static_cast<std::byte>(crc >> 8);
  return kUnit + pdu.size() + kCrc;
}

Answer Exchange::receive_tcp(int descriptor, std::uint8_t unit, const WireRequest& request,
                             Clock::time_point end, std::span<std::byte> room) {
  std::size_t held = 0;
  while (true) {
    if (held == room.size()) return {fault(Fault::BadAnswer), {}};
    if (const int error = receive_more(descriptor, room, held, end); error != 0)
      return {not_received(error), {}};
    while (true) {
      const pdu::TcpTake taken = pdu::take_frame(room.first(held));
      if (taken.state == pdu::TcpTake::State::Bad) return {fault(Fault::BadAnswer), {}};
      if (taken.state == pdu::TcpTake::State::NeedsMore) break;
      const auto behind = static_cast<std::uint16_t>(transaction_ - taken.frame.transaction);
      if (behind == 0) {
        if (taken.frame.unit != unit) return {fault(Fault::BadAnswer), {}};
        return judged(request, taken.frame.pdu);
      }
      if (behind > unanswered_) return {fault(Fault::BadAnswer), {}};
      const auto rest = room.first(held).subspan(taken.frame.bytes);
      std::ranges::copy(rest, room.begin());
      held = rest.size();
    }
  }
}

// How long it is the request says, or the function's top bit.
Answer Exchange::receive_rtu(int descriptor, std::uint8_t unit, const WireRequest& request,
                             Clock::time_point end, std::span<std::byte> room) {
  constexpr std::size_t kExceptionPdu = 2;
  std::size_t held = 0;
  std::size_t wanted = kUnit + kExceptionPdu + kCrc;
  while (held < wanted) {
    if (const int error = receive_more(descriptor, room.first(wanted), held, end); error != 0)
      return {not_received(error), {}};
    const bool known = held > kUnit;
    const bool refused = known && (room[kUnit] & std::byte{0x80}) != std::byte{0};
    if (known && !refused) wanted = kUnit + request.answer_bytes() + kCrc;
  }
  const auto frame = room.first(held);
  if (pdu::crc16(frame) != 0 || frame[0] != static_cast<std::byte>(unit))
    return {fault(Fault::BadAnswer), {}};
  return judged(request, frame.subspan(kUnit, held - kUnit - kCrc));
}

}  // namespace stepwright::modbus::master
