#pragma once

// One request and its answer on a descriptor that is connected: a TCP connection, or a serial line whose
// settings are made. Every part of the answer's frame is held against the request before anything of it is
// believed: of a TCP frame transaction, protocol, length and unit, of an RTU frame checksum, length and unit.
//
//   Exchange exchange({.framing = Framing::Tcp});
//   std::array<std::byte, pdu::kMaxPdu> room;
//   const Answer answer = exchange.ask(descriptor, unit, request, 300ms, room);
//   if (answer.outcome.good()) use(request.table(answer.pdu));
//
// Threads: one at a time. A call is over within its timeout. Late answers of earlier requests are passed over
// where their transaction says so; an RTU frame does not say.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/modbus/master/endpoint.h"
#include "runtime/modbus/master/outcome.h"
#include "runtime/modbus/master/wire_request.h"

namespace stepwright::modbus::master {

struct ExchangeOptions {
  Framing framing = Framing::Tcp;
  bool echo = false;  // an adapter repeats to this side all that it sends
};

struct Answer {
  Outcome outcome;
  std::span<const std::byte> pdu;  // of a good one, within the caller's room
};

class Exchange {
 public:
  explicit Exchange(const ExchangeOptions& options) : options_(options) {}

  // `room`: kMaxAdu bytes. Timeout, ConnectionLost, Exception or BadAnswer are its faults.
  Answer ask(int descriptor, std::uint8_t unit, const WireRequest& request, std::chrono::milliseconds timeout,
             std::span<std::byte> room);

  static constexpr std::size_t kMaxAdu = 512;  // a TCP frame of 260 bytes, an echo before an RTU frame of 256

 private:
  using Clock = std::chrono::steady_clock;
  std::size_t framed(std::uint8_t unit, const WireRequest& request, std::span<std::byte> out);
  Answer receive_tcp(int descriptor, std::uint8_t unit, const WireRequest& request, Clock::time_point end,
                     std::span<std::byte> room);
  Answer receive_rtu(int descriptor, std::uint8_t unit, const WireRequest& request, Clock::time_point end,
                     std::span<std::byte> room);

  ExchangeOptions options_;
  std::uint16_t transaction_ = 0;
  std::uint16_t unanswered_ = 0;  // requests right before this one whose answers may still come
};

}  // namespace stepwright::modbus::master
