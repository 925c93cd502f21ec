#pragma once

// Frames of Modbus TCP: a header of seven bytes (MBAP) before the PDU (Modbus Messaging on TCP/IP
// Implementation Guide V1.0b, 3.1.3). TCP is a stream: a frame may arrive in pieces, several may arrive at
// once.
//
// Portable, no heap, any thread. Nothing is read beyond the bytes that are there.
//
//   while (true) {
//     const TcpTake take = take_frame(buffer);
//     if (take.state != TcpTake::State::Frame) break;       // NeedsMore: wait; Bad: close the connection
//     ... take.frame.pdu ...
//     buffer = buffer.subspan(take.frame.bytes);
//   }

#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/modbus/pdu/request.h"

namespace stepwright::modbus::pdu {

inline constexpr std::size_t kTcpHeader = 7;
inline constexpr std::size_t kMaxTcpFrame = kTcpHeader + kMaxPdu;
// As long as a request may say that it is: its count of bytes has eight bits. One that is longer than kMaxPdu
// is answered with an exception, and the connection stays.
inline constexpr std::size_t kMaxCountedPdu = 10 + 255;  // FC 23
inline constexpr std::size_t kMaxTcpRequest = kTcpHeader + kMaxCountedPdu;

struct TcpFrame {
  std::uint16_t transaction = 0;
  std::uint8_t unit = 0;
  std::span<const std::byte> pdu;  // 1 to kMaxCountedPdu bytes of the buffer
  std::size_t bytes = 0;           // of the whole frame
};

struct TcpTake {
  enum class State : std::uint8_t { NeedsMore, Bad, Frame };
  State state = State::NeedsMore;
  TcpFrame frame;
};

// The first frame of a stream's unread bytes. Bad, as soon as it can be known: a protocol other than 0, or a
// length outside of 2 to 266 (unit and PDU). A stream has no place at which it could be picked up again after
// that.
TcpTake take_frame(std::span<const std::byte> bytes);

// Where the PDU of an answer stands in its frame (kMaxTcpFrame bytes).
std::span<std::byte> tcp_pdu(std::span<std::byte> frame);

// Writes the header around a PDU that already stands in tcp_pdu(); the length of the frame.
std::size_t seal_tcp(std::span<std::byte> frame, std::uint16_t transaction, std::uint8_t unit,
                     std::size_t pdu_bytes);

}  // namespace stepwright::modbus::pdu
