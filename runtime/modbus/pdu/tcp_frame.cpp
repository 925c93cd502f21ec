#include "runtime/modbus/pdu/tcp_frame.h"

#include "runtime/modbus/pdu/wire.h"

namespace stepwright::modbus::pdu {
namespace {

constexpr std::size_t kProtocolAt = 2;
constexpr std::size_t kLengthAt = 4;
constexpr std::size_t kUnitAt = 6;
constexpr std::size_t kShortest = 2;  // unit and a function code
constexpr std::size_t kLongest = 1 + kMaxCountedPdu;

}  // namespace

TcpTake take_frame(std::span<const std::byte> bytes) {
  using State = TcpTake::State;
  if (bytes.size() >= kLengthAt && get16(bytes, kProtocolAt) != 0) return {State::Bad, {}};
  if (bytes.size() < kUnitAt) return {State::NeedsMore, {}};
  const std::size_t length = get16(bytes, kLengthAt);
  if (length < kShortest || length > kLongest) return {State::Bad, {}};
  if (bytes.size() < kUnitAt + length) return {State::NeedsMore, {}};
  TcpFrame frame;
  frame.transaction = get16(bytes, 0);
  frame.unit = std::to_integer<std::uint8_t>(bytes[kUnitAt]);
  frame.pdu = bytes.subspan(kTcpHeader, length - 1);
  frame.bytes = kUnitAt + length;
  return {State::Frame, frame};
}

std::span<std::byte> tcp_pdu(std::span<std::byte> frame) {
  return frame.subspan(kTcpHeader, kMaxPdu);
}

std::size_t seal_tcp(std::span<std::byte> frame, std::uint16_t transaction, std::uint8_t unit,
                     std::size_t pdu_bytes) {
  put16(frame, 0, transaction);
  put16(frame, kProtocolAt, 0);
  put16(frame, kLengthAt, static_cast<std::uint16_t>(pdu_bytes + 1));
  frame[kUnitAt] = static_cast<std::byte>(unit);
  return kTcpHeader + pdu_bytes;
}

}  // namespace stepwright::modbus::pdu
