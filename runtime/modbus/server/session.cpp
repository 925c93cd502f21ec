#include "runtime/modbus/server/session.h"

#include <algorithm>
#include <cstring>

#include "runtime/modbus/pdu/answer.h"
#include "runtime/modbus/pdu/identification.h"

namespace stepwright::modbus::server {

using pdu::Exception;
using pdu::Function;

Session::Session(std::uint64_t ticket, std::unique_ptr<Transport> transport, const Shared& shared,
                 Clock::time_point now)
    : ticket_(ticket),
      transport_(std::move(transport)),
      shared_(shared),
      rtu_(transport_->unit()),
      rtu_framing_(transport_->framing() == Framing::Rtu),
      heard_(now),
      answered_(now) {}

void Session::readable(Clock::time_point now) {
  do {
    take(now);
    go_on(now);
  } while (transport_->has_buffered() && wants_read() && !pending_);
}

void Session::writable(Clock::time_point now) {
  flush(now);
  if (done_) return;
  // A handshake goes on with reading; and what waited for room in the output is served now.
  if (transport_->needs_writable() || !greeted_) take(now);
  go_on(now);
}

void Session::written(Exception exception, Clock::time_point now) {
  if (!pending_ || done_) return;
  pending_ = false;
  const auto out = std::span(out_).subspan(out_end_);
  const auto place = rtu_framing_ ? pdu::rtu_pdu(out) : pdu::tcp_pdu(out);
  std::size_t bytes = 0;
  if (exception == Exception::None && request_.function == Function::ReadWriteMultipleRegisters) {
    const std::size_t table = pdu::table_bytes(request_);
    exception = shared_.data.read(request_, pdu::table_data(place, table));
    bytes = pdu::answer_table(request_.function, table, place);
  } else {
    bytes = pdu::answer_write(request_, place);
  }
  if (exception != Exception::None)
    bytes = refused(exception, static_cast<std::uint8_t>(request_.function), place);
  send_answer(bytes);
  in_begin_ += frame_bytes_;
  go_on(now);
}

// Serves what is there and sends what came of it, as long as either makes room for the other.
void Session::go_on(Clock::time_point now) {
  bool full = true;
  while (!done_ && full) {
    serve_all();
    full = !out_room();
    flush(now);
    full = full && out_room();
  }
  // Who only stopped sending gets the answers that are due.
  if (ended_ && !pending_ && out_begin_ == out_end_) done_ = true;
}

void Session::check(Clock::time_point now) {
  const ServerOptions& options = shared_.options;
  const bool stuck = out_end_ > out_begin_ && now - answered_ > options.send_timeout;
  const bool idle = options.idle_timeout.count() > 0 && !pending_ && now - heard_ > options.idle_timeout;
  const bool stranger = !greeted_ && transport_->peer() == nullptr && now - heard_ > options.greeting_timeout;
  if (stuck || (idle && !rtu_framing_) || stranger) drop();
}

// Reads what fits, once.
void Session::take(Clock::time_point now) {
  if (done_) return;
  if (rtu_framing_ && !pending_ && now - heard_ >= kRtuSilence && in_begin_ == in_end_) rtu_.silence();
  // The request under way lies in the buffer and must not move.
  if (in_begin_ > 0 && !pending_) {
    std::memmove(in_.data(), in_.data() + in_begin_, in_end_ - in_begin_);
    in_end_ -= in_begin_;
    in_begin_ = 0;
  }
  if (in_end_ == kInput) return;
  const Moved moved = transport_->read(std::span(in_).subspan(in_end_));
  if (moved.state == Moved::State::Closed) ended_ = true;
  if (moved.state == Moved::State::Done) {
    in_end_ += moved.bytes;
    // A handshake under way counts from its beginning.
    if (greeted_ || transport_->peer() != nullptr) heard_ = now;
  }
  if (greeted_) return;
  if (const Peer* peer = transport_->peer()) {
    rights_ = shared_.access.of(*peer);
    greeted_ = true;
    heard_ = now;
  }
}

void Session::serve_all() {
  while (!done_ && !pending_ && greeted_ && out_room()) {
    if (!(rtu_framing_ ? next_rtu() : next_tcp())) return;
  }
}

bool Session::next_tcp() {
  const auto held = std::span<const std::byte>(in_).subspan(in_begin_, in_end_ - in_begin_);
  const pdu::TcpTake taken = pdu::take_frame(held);
  if (taken.state == pdu::TcpTake::State::Bad) {
    ++shared_.figures.malformed;
    drop();
    return false;
  }
  if (taken.state == pdu::TcpTake::State::NeedsMore) return false;
  transaction_ = taken.frame.transaction;
  unit_ = taken.frame.unit;
  silent_ = false;
  frame_bytes_ = taken.frame.bytes;
  serve(taken.frame.pdu);
  if (!pending_) in_begin_ += taken.frame.bytes;
  return true;
}

bool Session::next_rtu() {
  pdu::RtuFrame frame = rtu_.take();
  while (!frame && in_begin_ < in_end_) {
    rtu_.push(in_[in_begin_++]);
    frame = rtu_.take();
  }
  if (!frame) return false;
  unit_ = frame.address;
  silent_ = frame.broadcast();
  frame_bytes_ = 0;
  serve(frame.pdu);
  return true;
}

// Answers a request, or begins its write.
void Session::serve(std::span<const std::byte> request) {
  ++shared_.figures.requests;
  const auto out = std::span(out_).subspan(out_end_);
  const std::size_t bytes = answer(request, rtu_framing_ ? pdu::rtu_pdu(out) : pdu::tcp_pdu(out));
  if (!pending_) send_answer(bytes);
}

std::size_t Session::answer(std::span<const std::byte> request, std::span<std::byte> out) {
  const pdu::Parsed parsed = pdu::parse(request);
  std::size_t bytes = 0;
  if (other_unit(out, parsed.function, bytes)) return bytes;
  if (parsed.exception != Exception::None) return refused(parsed.exception, parsed.function, out);
  request_ = parsed.request;
  if (silent_ && !request_.writes()) return 0;  // a broadcast that reads
  const Exception exception = permitted(request_);
  if (exception != Exception::None) return refused(exception, parsed.function, out);
  return carry_out(request_, out);
}

std::size_t Session::carry_out(const pdu::Request& request, std::span<std::byte> out) {
  const auto function = static_cast<std::uint8_t>(request.function);
  if (request.function == Function::EncapsulatedInterface)
    return pdu::answer_identification(request, shared_.identity, out);
  if (request.writes()) {
    const Exception exception = shared_.data.begin_write(ticket_, request);
    if (exception != Exception::None) return refused(exception, function, out);
    ++shared_.figures.writes;
    pending_ = true;
    return 0;
  }
  const std::size_t table = pdu::table_bytes(request);
  const Exception exception = shared_.data.read(request, pdu::table_data(out, table));
  if (exception != Exception::None) return refused(exception, function, out);
  return pdu::answer_table(request.function, table, out);
}

Exception Session::permitted(const pdu::Request& request) const {
  using map::Table;
  switch (request.function) {
    case Function::ReadCoils:
      return rights_.read(Table::Coils, request.address, request.count);
    case Function::ReadDiscreteInputs:
      return rights_.read(Table::DiscreteInputs, request.address, request.count);
    case Function::ReadHoldingRegisters:
      return rights_.read(Table::HoldingRegisters, request.address, request.count);
    case Function::ReadInputRegisters:
      return rights_.read(Table::InputRegisters, request.address, request.count);
    case Function::WriteSingleCoil:
    case Function::WriteMultipleCoils:
      return rights_.write(Table::Coils, request.address, request.count);
    case Function::WriteSingleRegister:
    case Function::WriteMultipleRegisters:
    case Function::MaskWriteRegister:
      return rights_.write(Table::HoldingRegisters, request.address, request.count);
    case Function::ReadWriteMultipleRegisters: {
      const Exception read = rights_.read(Table::HoldingRegisters, request.address, request.count);
      if (read != Exception::None) return read;
      return rights_.write(Table::HoldingRegisters, request.write_address, request.write_count);
    }
    case Function::EncapsulatedInterface:
      break;
  }
  return Exception::None;
}

std::size_t Session::refused(Exception exception, std::uint8_t function, std::span<std::byte> out) {
  ++shared_.figures.exceptions[static_cast<std::size_t>(exception) % shared_.figures.exceptions.size()];
  return pdu::answer_exception(function, exception, out);
}

// True if the unit is none of ours: `bytes` is the answer, 0 for none.
bool Session::other_unit(std::span<std::byte> out, std::uint8_t function, std::size_t& bytes) {
  const auto& units = shared_.options.units;
  if (rtu_framing_ || units.empty() || std::find(units.begin(), units.end(), unit_) != units.end())
    return false;
  if (shared_.options.answer_unknown_units) bytes = refused(Exception::GatewayTargetFailed, function, out);
  return true;
}

// The answer that stands in the output buffer gets its frame.
void Session::send_answer(std::size_t pdu_bytes) {
  if (pdu_bytes == 0 || silent_) return;
  const auto out = std::span(out_).subspan(out_end_);
  out_end_ += rtu_framing_ ? pdu::seal_rtu(out, unit_, pdu_bytes)
                           : pdu::seal_tcp(out, transaction_, unit_, pdu_bytes);
}

void Session::flush(Clock::time_point now) {
  while (!done_ && out_begin_ < out_end_) {
    const Moved moved = transport_->write(std::span(out_).subspan(out_begin_, out_end_ - out_begin_));
    if (moved.state == Moved::State::Closed) done_ = true;
    if (moved.state != Moved::State::Done) break;
    out_begin_ += moved.bytes;
    answered_ = now;
  }
  if (out_begin_ == out_end_) {
    out_begin_ = out_end_ = 0;
    answered_ = now;
    return;
  }
  // What is left moves to the front, so that there is room for the answers that wait.
  if (out_begin_ == 0) return;
  std::memmove(out_.data(), out_.data() + out_begin_, out_end_ - out_begin_);
  out_end_ -= out_begin_;
  out_begin_ = 0;
}

void Session::drop() {
  ++shared_.figures.dropped;
  done_ = true;
}

}  // namespace stepwright::modbus::server
