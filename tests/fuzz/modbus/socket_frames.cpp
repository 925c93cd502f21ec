#include "tests/fuzz/modbus/socket_frames.h"

#include <algorithm>
#include <array>

#include "tests/fuzz/modbus/mutation.h"

namespace stepwright::fuzz::modbus {

namespace {

constexpr std::size_t kUnitAt = 6;
constexpr std::size_t kLengthAt = 4;

void append(Bytes& out, const Bytes& more) {
  out.resize(out.size() + more.size());
  std::ranges::copy(more, out.end() - static_cast<std::ptrdiff_t>(more.size()));
}

// So that a mutation gets as far as the engine.
Bytes with_right_length(Bytes frame) {
  frame.resize(std::clamp<std::size_t>(frame.size(), 8, 260));
  frame[2] = frame[3] = frame[kLengthAt] = 0;
  frame[kLengthAt + 1] = static_cast<std::uint8_t>(frame.size() - kLengthAt - 2);
  return frame;
}

// Not pdu::take_frame: a server must not be tested with its own mistake.
void judge(const Bytes& stream, Burst& burst) {
  constexpr std::size_t kMostLength = 266;
  std::size_t at = 0;
  while (at < stream.size()) {
    const std::size_t left = stream.size() - at;
    const bool other = left >= 4 && (stream[at + 2] != 0 || stream[at + 3] != 0);
    const std::size_t length = left >= 6 ? static_cast<std::size_t>(stream[at + 4] << 8 | stream[at + 5]) : 2;
    if (other || length < 2 || length > kMostLength) {
      burst.ending = Ending::Bad;
      return;
    }
    if (left < 6 + length) {
      burst.ending = Ending::Half;
      return;
    }
    at += 6 + length;
    ++burst.whole;
  }
}

}  // namespace

// All 256 function codes x 256 units in 65536 turns; the body is random, or of a kind that may be right.
Bytes SocketFrames::any_pdu() {
  constexpr std::array<unsigned, 8> kCounts{0, 1, 8, 123, 125, 126, 2000, 0xFFFF};
  const auto function = static_cast<std::uint8_t>(turn_ & 0xFF);
  Bytes pdu{function};
  if (below(3) == 0) {
    pdu.resize(1 + below(252));
    for (std::size_t i = 1; i < pdu.size(); ++i) pdu[i] = static_cast<std::uint8_t>(random_());
    return pdu;
  }
  const unsigned address = static_cast<unsigned>(below(2) == 0 ? below(64) : below(65536));
  const unsigned count = kCounts[below(kCounts.size())];
  for (const unsigned word : {address, count}) {
    pdu.push_back(static_cast<std::uint8_t>(word >> 8));
    pdu.push_back(static_cast<std::uint8_t>(word));
  }
  if (function != 15 && function != 16) return pdu;
  const std::size_t bytes = std::min<std::size_t>(function == 15 ? (count + 7) / 8 : count * 2, 246);
  pdu.push_back(static_cast<std::uint8_t>(bytes));
  pdu.resize(pdu.size() + bytes, static_cast<std::uint8_t>(random_()));
  return pdu;
}

Bytes SocketFrames::any_frame() {
  ++turn_;
  const std::size_t kind = below(20);
  if (kind < 2) return mutated(seeds_[below(seeds_.size())].bytes, seeds_, random_);
  if (kind < 6) return seeds_[below(seeds_.size())].bytes;
  if (kind < 9) return with_right_length(mutated(seeds_[below(seeds_.size())].bytes, seeds_, random_));
  Bytes frame = tcp_frame(any_pdu(), static_cast<std::uint16_t>(random_()));
  frame[kUnitAt] = static_cast<std::uint8_t>(turn_ >> 8);
  return frame;
}

Bytes SocketFrames::wrong_length(Bytes frame) {
  if (frame.size() <= kUnitAt) return frame;
  const std::size_t other = below(2) == 0 ? below(65536) : below(300);
  frame[kLengthAt] = static_cast<std::uint8_t>(other >> 8);
  frame[kLengthAt + 1] = static_cast<std::uint8_t>(other);
  return frame;
}

Burst SocketFrames::next() {
  Burst burst;
  Bytes stream;
  // Most come alone; some are merged or pipelined.
  burst.frames = below(4) == 0 ? 1 + static_cast<unsigned>(below(20)) : 1;
  for (unsigned i = 0; i < burst.frames; ++i) {
    Bytes frame = any_frame();
    // Only the last one may end the connection, so that none before it is lost.
    if (i + 1 < burst.frames) frame = with_right_length(std::move(frame));
    append(stream, i + 1 == burst.frames && below(60) == 0 ? wrong_length(std::move(frame)) : frame);
  }
  judge(stream, burst);
  if (below(4) != 0) {
    burst.pieces.push_back(std::move(stream));
    return burst;
  }
  while (!stream.empty()) {
    const auto cut = static_cast<std::ptrdiff_t>(1 + below(stream.size()));
    burst.pieces.emplace_back(stream.begin(), stream.begin() + cut);
    stream.erase(stream.begin(), stream.begin() + cut);
  }
  return burst;
}

}  // namespace stepwright::fuzz::modbus
