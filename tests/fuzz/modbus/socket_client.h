#pragma once

// A TCP client of the socket fuzz: it sends anything, in pieces, and looks at whatever comes back.
//
// Threads: one. Throws std::runtime_error where the server breaks its word.

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "tests/fuzz/modbus/seeds.h"

namespace stepwright::fuzz::modbus {

class SocketClient {
 public:
  SocketClient(std::uint16_t port, std::chrono::milliseconds patience);
  ~SocketClient();
  SocketClient(const SocketClient&) = delete;

  // Sends as the kernel takes it and reads what is there meanwhile, so that neither side waits for the other.
  // False when the server has closed the connection.
  bool send(std::span<const std::uint8_t> bytes);
  // Until so many answers more have come than before. Every byte must belong to a frame of Modbus/TCP.
  void await_answers(std::uint64_t count);
  // Until the server has closed the connection.
  void await_close();
  // A new connection; what was begun on the old one is left as it is.
  void connect();

  // Sends a request and waits for the one answer with its transaction. Requires a connection that nothing
  // else uses.
  Bytes ask(const Bytes& pdu);

  std::uint64_t answers() const { return answers_; }
  std::uint64_t exceptions() const { return exceptions_; }
  std::uint64_t reconnections() const { return reconnections_; }

 private:
  bool receive(bool wait);
  void take_frames();

  std::uint16_t port_;
  std::chrono::milliseconds patience_;
  int socket_ = -1;
  std::uint16_t transaction_ = 0;
  Bytes unread_;
  Bytes newest_;  // the frame that was taken last
  std::uint64_t answers_ = 0;
  std::uint64_t exceptions_ = 0;
  std::uint64_t reconnections_ = 0;
};

}  // namespace stepwright::fuzz::modbus
