#pragma once

// One client: what has arrived from it, what is still to be sent to it, and the request that waits for the
// controller.
//
// Requests are answered in their order. While a write is under way, those behind it wait in the input buffer;
// while a client does not read, its requests wait too, so that both buffers stay as they are: kInput and
// kOutput bytes. Threads: the server's. Nothing blocks.

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>

#include "runtime/modbus/pdu/data_model.h"
#include "runtime/modbus/pdu/rtu_frame.h"
#include "runtime/modbus/pdu/tcp_frame.h"
#include "runtime/modbus/server/access.h"
#include "runtime/modbus/server/options.h"
#include "runtime/modbus/server/process_data.h"
#include "runtime/modbus/server/transport.h"

namespace stepwright::modbus::server {

using Clock = std::chrono::steady_clock;

// State that all sessions of a server share.
struct Shared {
  const ServerOptions& options;
  const Access& access;
  const pdu::Identity& identity;
  ProcessData& data;
  ServerFigures& figures;
};

class Session {
 public:
  // `ticket` names the session's writes; no two sessions ever have the same.
  Session(std::uint64_t ticket, std::unique_ptr<Transport> transport, const Shared& shared,
          Clock::time_point now);

  const Transport& transport() const { return *transport_; }
  std::uint64_t ticket() const { return ticket_; }

  // The descriptor is readable, writable. Call done() afterwards.
  void readable(Clock::time_point now);
  void writable(Clock::time_point now);
  // The write under way is done.
  void written(pdu::Exception exception, Clock::time_point now);
  // Time has passed: whether it may stay is judged.
  void check(Clock::time_point now);

  // It is over: destroy it.
  bool done() const { return done_; }
  bool wants_read() const { return !done_ && !ended_ && in_room() && out_room(); }
  bool wants_write() const { return out_end_ > out_begin_ || transport_->needs_writable(); }

 private:
  static constexpr std::size_t kInput = 2'048;
  static constexpr std::size_t kOutput = 4'096;
  static constexpr std::chrono::milliseconds kRtuSilence{50};

  // While a request is under way the bytes before it stay.
  bool in_room() const { return in_end_ < kInput || (in_begin_ > 0 && !pending_); }
  bool out_room() const { return kOutput - out_end_ >= pdu::kMaxTcpFrame; }
  void take(Clock::time_point now);
  void take_buffered(Clock::time_point now);
  void go_on(Clock::time_point now);
  void serve_all();
  bool next_tcp();
  bool next_rtu();
  void serve(std::span<const std::byte> request);
  std::size_t answer(std::span<const std::byte> request, std::span<std::byte> out);
  std::size_t carry_out(const pdu::Request& request, std::span<std::byte> out);
  pdu::Exception permitted(const pdu::Request& request) const;
  std::size_t refused(pdu::Exception exception, std::uint8_t function, std::span<std::byte> out);
  bool other_unit(std::span<std::byte> out, std::uint8_t function, std::size_t& bytes);
  void send_answer(std::size_t pdu_bytes);
  void flush(Clock::time_point now);
  void drop();

  std::uint64_t ticket_;
  std::unique_ptr<Transport> transport_;
  const Shared& shared_;
  pdu::RtuReceiver rtu_;
  Rights rights_;
  bool greeted_ = false;  // the peer is known
  bool rtu_framing_;
  bool ended_ = false;  // nothing more will come
  bool done_ = false;

  // The request that is being answered.
  bool pending_ = false;  // it waits for the controller
  pdu::Request request_;
  std::uint16_t transaction_ = 0;
  std::uint8_t unit_ = 0;
  std::size_t frame_bytes_ = 0;  // of it in the input buffer (TCP)
  bool silent_ = false;          // nobody is answered

  Clock::time_point heard_;     // the newest bytes
  Clock::time_point answered_;  // the newest progress in sending
  std::size_t in_begin_ = 0;
  std::size_t in_end_ = 0;
  std::size_t out_begin_ = 0;
  std::size_t out_end_ = 0;
  std::array<std::byte, kInput> in_;
  std::array<std::byte, kOutput> out_;
};

}  // namespace stepwright::modbus::server
