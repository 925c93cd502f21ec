#include "tests/fuzz/modbus/slave_run.h"

#include <algorithm>
#include <vector>

#include "runtime/modbus/pdu/request.h"
#include "runtime/modbus/pdu/rtu_frame.h"
#include "runtime/modbus/pdu/serve.h"
#include "runtime/modbus/pdu/tcp_frame.h"
#include "tests/fuzz/modbus/seeds.h"
#include "tests/fuzz/modbus/strict_model.h"

namespace stepwright::fuzz::modbus {

namespace {

namespace pdu = stepwright::modbus::pdu;

const Bytes kValid{0x03, 0x00, 0x00, 0x00, 0x02};
constexpr std::size_t kValidAnswer = 6;  // function, byte count, two registers
// A slave that begins a request of the longest kind in noise needs this many valid ones until it sees the
// next.
constexpr int kMostLost = 80;

std::uint8_t at(std::span<const std::byte> bytes, std::size_t index) {
  return std::to_integer<std::uint8_t>(bytes[index]);
}

// Why an answer PDU does not belong to its request; empty if it does.
std::string wrong_answer(std::span<const std::byte> request, std::span<const std::byte> answer) {
  if (answer.empty() || answer.size() > pdu::kMaxPdu) return "an answer of " + std::to_string(answer.size());
  const std::uint8_t function = at(request, 0);
  if (answer.size() == 2 && at(answer, 0) == (function | 0x80)) {
    const std::uint8_t code = at(answer, 1);
    return code >= 1 && code <= 4 ? "" : "exception " + std::to_string(code);
  }
  if (function >= 0x80 || at(answer, 0) != function) return "another function code";
  switch (function) {
    case 1:
    case 2:
    case 3:
    case 4:
    case 23:
      return answer.size() == 2u + at(answer, 1) ? "" : "a byte count that is wrong";
    case 5:
    case 6:
      return std::ranges::equal(request, answer) ? "" : "no echo";
    case 15:
    case 16:
      return answer.size() == 5 && std::ranges::equal(request.first(5), answer) ? "" : "no echo";
    case 22:
      return std::ranges::equal(request, answer) ? "" : "no echo";
    case 43:
      return answer.size() >= 7 ? "" : "a short identification";
    default:
      return "an answer to a function that is not served";
  }
}

// A slave as the host has it: a buffer of one frame, in which what is left over moves to the front.
class TcpSlave {
 public:
  explicit TcpSlave(Side side) : input_(pdu::kMaxTcpFrame, side), output_(pdu::kMaxPdu, side) {}

  // False at a frame that ends the connection, or at a finding.
  bool take(std::span<const std::uint8_t> piece, Run& run) {
    while (!piece.empty()) {
      const std::size_t room = std::min(piece.size(), input_.inner().size() - used_);
      std::copy_n(piece.begin(), room, input_.inner().begin() + static_cast<std::ptrdiff_t>(used_));
      used_ += room;
      piece = piece.subspan(room);
      if (!serve_all(run)) return false;
      if (used_ == input_.inner().size()) {
        run.finding = "a full buffer without a frame";
        return false;
      }
    }
    return true;
  }

 private:
  bool serve_all(Run& run) {
    while (true) {
      // A view that ends where the bytes do, copied against the guard: nothing may be read behind it.
      Guarded<std::uint8_t> view(used_, Side::Back);
      std::copy_n(input_.inner().begin(), used_, view.inner().begin());
      const pdu::TcpTake taken = pdu::take_frame(std::as_bytes(view.inner()));
      if (taken.state == pdu::TcpTake::State::Bad) return false;
      if (taken.state == pdu::TcpTake::State::NeedsMore) return true;
      ++run.frames;
      const auto out = std::as_writable_bytes(output_.inner());
      const std::size_t length = pdu::serve(model_, taken.frame.pdu, out);
      if (length > out.size()) run.finding = "an answer that is too long";
      if (run.finding.empty()) run.finding = wrong_answer(taken.frame.pdu, out.first(length));
      if (!run.finding.empty()) return false;
      if (length > 2) ++run.answers;
      const std::size_t bytes = taken.frame.bytes;
      std::copy(input_.inner().begin() + static_cast<std::ptrdiff_t>(bytes),
                input_.inner().begin() + static_cast<std::ptrdiff_t>(used_), input_.inner().begin());
      used_ -= bytes;
    }
  }

  Guarded<std::uint8_t> input_;
  Guarded<std::uint8_t> output_;
  std::size_t used_ = 0;
  StrictModel model_;
};

class RtuSlave {
 public:
  explicit RtuSlave(Side side) : output_(pdu::kMaxRtuFrame, side) {}

  void take(std::span<const std::uint8_t> bytes, Run& run) {
    for (const std::uint8_t byte : bytes) {
      receiver_.push(std::byte{byte});
      while (const pdu::RtuFrame frame = receiver_.take()) serve(frame, run);
    }
  }
  void silence() { receiver_.silence(); }

 private:
  void serve(const pdu::RtuFrame& frame, Run& run) {
    ++run.frames;
    const std::vector<std::byte> request(frame.pdu.begin(), frame.pdu.end());
    const std::uint8_t address = frame.address;
    const auto out = std::as_writable_bytes(output_.inner());
    const std::size_t length = pdu::serve_rtu(model_, frame, out);
    if (address != kAddress && address != pdu::kBroadcast) run.finding = "a frame of another slave";
    if (address == pdu::kBroadcast && length != 0) run.finding = "a broadcast was answered";
    if (address == pdu::kBroadcast || !run.finding.empty()) return;
    if (length < 4 || length > out.size()) {
      run.finding = "an answer frame of " + std::to_string(length);
      return;
    }
    const Bytes body(output_.inner().begin() + 1,
                     output_.inner().begin() + static_cast<std::ptrdiff_t>(length - 2));
    const Bytes whole(output_.inner().begin(), output_.inner().begin() + static_cast<std::ptrdiff_t>(length));
    if (whole != rtu_frame(body, kAddress)) run.finding = "an answer with another address or a wrong CRC";
    if (run.finding.empty()) run.finding = wrong_answer(request, out.subspan(1, length - 3));
    if (length > 5) ++run.answers;
  }

  pdu::RtuReceiver receiver_{kAddress};
  Guarded<std::uint8_t> output_;
  StrictModel model_;
};

}  // namespace

Run run_tcp(std::span<const std::uint8_t> stream, std::uint32_t pieces, Side side) {
  Run run;
  TcpSlave slave(side);
  bool open = true;
  while (open && !stream.empty()) {
    pieces = pieces * 1664525u + 1013904223u;
    const std::size_t piece = std::min<std::size_t>(stream.size(), 1 + (pieces >> 24) % 64);
    open = slave.take(stream.first(piece), run);
    stream = stream.subspan(piece);
  }
  if (!run.finding.empty()) return run;
  // The next client's request.
  TcpSlave next(side);
  Run valid;
  next.take(tcp_frame(kValid, 7), valid);
  if (!valid.finding.empty() || valid.answers != 1)
    run.finding = "a valid request has no answer: " + valid.finding;
  return run;
}

Run run_rtu(std::span<const std::uint8_t> line, Side side) {
  static_assert(kValidAnswer > 2);
  Run run;
  const Bytes valid = rtu_frame(kValid, kAddress);
  {
    // Without any silence: requests that go on coming must get through.
    RtuSlave slave(side);
    slave.take(line, run);
    Run after;
    for (int tries = 0; tries < kMostLost && after.answers == 0; ++tries) slave.take(valid, after);
    if (after.answers == 0 || !after.finding.empty())
      run.finding = "no valid request gets through: " + after.finding;
  }
  if (!run.finding.empty()) return run;
  RtuSlave slave(side);
  Run ignored, after;
  slave.take(line, ignored);
  slave.silence();
  slave.take(valid, after);
  if (after.answers != 1 || !after.finding.empty())
    run.finding = "a valid request after a silence has no answer: " + after.finding;
  return run;
}

}  // namespace stepwright::fuzz::modbus
