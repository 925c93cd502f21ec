#include "tests/fuzz/modbus/slave_run.h"

#include <algorithm>
#include <array>
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

// Memory at guard pages, mapped once: mapping it for each run would take longer than the run.
struct Pages {
  explicit Pages(Side side) : pdu_out(pdu::kMaxPdu, side), frame_out(pdu::kMaxRtuFrame, side) {}

  // A copy behind which nothing may be read.
  std::span<const std::byte> view(std::span<const std::uint8_t> bytes) {
    const std::span<std::uint8_t> tail = input.inner().last(bytes.size());
    std::ranges::copy(bytes, tail.begin());
    return std::as_bytes(tail);
  }

  Guarded<std::uint8_t> input{pdu::kMaxTcpRequest, Side::Back};
  Guarded<std::uint8_t> pdu_out;
  Guarded<std::uint8_t> frame_out;
};

Pages& pages_of(Side side) {
  static Pages front(Side::Front), back(Side::Back);
  return side == Side::Front ? front : back;
}

// A slave as the host has it: a buffer of one frame, in which what is left over moves to the front.
class TcpSlave {
 public:
  explicit TcpSlave(Pages& pages) : pages_(pages) {}

  // False at a frame that ends the connection, or at a finding.
  bool take(std::span<const std::uint8_t> piece, Run& run) {
    while (!piece.empty()) {
      const std::size_t room = std::min(piece.size(), input_.size() - used_);
      std::copy_n(piece.begin(), room, input_.begin() + static_cast<std::ptrdiff_t>(used_));
      used_ += room;
      piece = piece.subspan(room);
      if (!serve_all(run)) return false;
      if (used_ == input_.size()) {
        run.finding = "a full buffer without a frame";
        return false;
      }
    }
    return true;
  }

 private:
  bool serve_all(Run& run) {
    while (true) {
      const pdu::TcpTake taken = pdu::take_frame(pages_.view(std::span(input_).first(used_)));
      if (taken.state == pdu::TcpTake::State::Bad) return false;
      if (taken.state == pdu::TcpTake::State::NeedsMore) return true;
      ++run.frames;
      const auto out = std::as_writable_bytes(pages_.pdu_out.inner());
      const std::size_t length = pdu::serve(model_, taken.frame.pdu, out);
      if (length > out.size()) run.finding = "an answer that is too long";
      if (run.finding.empty()) run.finding = wrong_answer(taken.frame.pdu, out.first(length));
      if (!run.finding.empty()) return false;
      if (length > 2) ++run.answers;
      const std::size_t bytes = taken.frame.bytes;
      std::ranges::copy(std::span(input_).subspan(bytes, used_ - bytes), input_.begin());
      used_ -= bytes;
    }
  }

  Pages& pages_;
  std::array<std::uint8_t, pdu::kMaxTcpRequest> input_{};
  std::size_t used_ = 0;
  StrictModel model_;
};

class RtuSlave {
 public:
  explicit RtuSlave(Pages& pages) : pages_(pages) {}

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
    const std::span<std::uint8_t> bytes = pages_.frame_out.inner();
    const auto out = std::as_writable_bytes(bytes);
    const std::size_t length = pdu::serve_rtu(model_, frame, out);
    if (address != kAddress && address != pdu::kBroadcast) run.finding = "a frame of another slave";
    if (address == pdu::kBroadcast && length != 0) run.finding = "a broadcast was answered";
    if (address == pdu::kBroadcast || !run.finding.empty()) return;
    if (length < 4 || length > out.size()) {
      run.finding = "an answer frame of " + std::to_string(length);
      return;
    }
    const Bytes whole(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    const Bytes body(whole.begin() + 1, whole.end() - 2);
    if (whole != rtu_frame(body, kAddress)) run.finding = "an answer with another address or a wrong CRC";
    if (run.finding.empty()) run.finding = wrong_answer(request, out.subspan(1, length - 3));
    if (length > 5) ++run.answers;
  }

  Pages& pages_;
  pdu::RtuReceiver receiver_{kAddress};
  StrictModel model_;
};

}  // namespace

Run run_tcp(std::span<const std::uint8_t> stream, std::uint32_t pieces, Side side) {
  Run run;
  TcpSlave slave(pages_of(side));
  bool open = true;
  while (open && !stream.empty()) {
    pieces = pieces * 1664525u + 1013904223u;
    const std::size_t piece = std::min<std::size_t>(stream.size(), 1 + (pieces >> 24) % 64);
    open = slave.take(stream.first(piece), run);
    stream = stream.subspan(piece);
  }
  if (!run.finding.empty()) return run;
  // The next client's request.
  TcpSlave next(pages_of(side));
  Run valid;
  next.take(tcp_frame(kValid, 7), valid);
  if (!valid.finding.empty() || valid.answers != 1)
    run.finding = "a valid request has no answer: " + valid.finding;
  if (run.finding.empty() && !pages_of(side).pdu_out.intact())
    run.finding = "bytes beside the answer were written";
  return run;
}

Run run_rtu(std::span<const std::uint8_t> line, Side side) {
  Run run;
  const Bytes valid = rtu_frame(kValid, kAddress);
  {
    // Without any silence: requests that go on coming must get through.
    RtuSlave slave(pages_of(side));
    slave.take(line, run);
    Run after;
    for (int tries = 0; tries < kMostLost && after.answers == 0; ++tries) slave.take(valid, after);
    if (after.answers == 0 || !after.finding.empty())
      run.finding = "no valid request gets through: " + after.finding;
  }
  if (!run.finding.empty()) return run;
  RtuSlave slave(pages_of(side));
  Run ignored, after;
  slave.take(line, ignored);
  slave.silence();
  slave.take(valid, after);
  if (after.answers != 1 || !after.finding.empty())
    run.finding = "a valid request after a silence has no answer: " + after.finding;
  if (run.finding.empty() && !pages_of(side).frame_out.intact())
    run.finding = "bytes beside the answer were written";
  return run;
}

}  // namespace stepwright::fuzz::modbus
