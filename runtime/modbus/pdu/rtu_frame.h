#pragma once

// Frames of Modbus RTU as a slave receives them (Modbus over Serial Line V1.02, 2.5.1): address, PDU, CRC.
//
// The standard ends a frame by a silence of 3.5 characters, which neither an operating system's serial line
// nor an emulated one keeps. So frames are taken by the length that their function code and byte count give,
// and the CRC decides. Frames of other slaves and answers of theirs on the same line are passed over. After
// garbage the receiver tries every next byte as a beginning. Silence helps where it can be seen, however
// coarse (50 ms): what is begun is thrown away.
//
// Portable, no heap: 256 bytes of buffer. One thread. A frame is valid until the next push() or silence().
//
//   receiver.push(byte);
//   while (const auto frame = receiver.take()) {
//     const std::size_t length = serve_rtu(model, *frame, out);   // 0: a broadcast, which nobody answers
//     ... send out[0, length) ...
//   }

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/modbus/pdu/data_model.h"
#include "runtime/modbus/pdu/request.h"

namespace stepwright::modbus::pdu {

inline constexpr std::size_t kMaxRtuFrame = kMaxPdu + 3;
inline constexpr std::uint8_t kBroadcast = 0;

struct RtuFrame {
  std::uint8_t address = 0;
  std::span<const std::byte> pdu;
  explicit operator bool() const { return !pdu.empty(); }
  bool broadcast() const { return address == kBroadcast; }
};

class RtuReceiver {
 public:
  // `address`: of this slave, 1 to 247. Frames to it and broadcasts are given out.
  explicit RtuReceiver(std::uint8_t address) : address_(address) {}

  // The next byte of the line. If take() was not called until it gave nothing, the oldest byte is lost.
  void push(std::byte byte);

  // The next whole frame for this slave; converts to false if there is none yet.
  RtuFrame take();

  // The line was silent: what has begun is no frame. Requires that take() gave nothing.
  void silence();

  // Bytes that belonged to no frame with a right CRC.
  std::uint32_t garbage_bytes() const { return garbage_; }

 private:
  enum class Judgement : std::uint8_t { NeedsMore, Garbage, Frame };
  struct Judged {
    Judgement judgement = Judgement::NeedsMore;
    std::size_t bytes = 0;
  };
  Judged judge();
  Judged judge_unknown();
  Judged judge_other() const;
  bool is_frame(std::size_t bytes) const;
  std::span<const std::byte> held() const { return std::span(buffer_).first(used_); }
  void drop(std::size_t bytes);

  std::uint8_t address_;
  std::array<std::byte, kMaxRtuFrame> buffer_{};
  std::size_t used_ = 0;
  std::size_t given_ = 0;  // bytes of the frame that was given out last and is still in the buffer
  std::uint32_t garbage_ = 0;
  // Since a byte that belonged to nothing, no frame has been found. Then a beginning that could be another
  // slave's is none: what looks like its length would swallow the next request.
  bool lost_ = false;
  // How far a frame of unknown length has been looked at, so that every byte is looked at once.
  std::size_t tried_ = 0;
  std::uint16_t tried_crc_ = 0;
};

// Where the PDU of an answer stands in its frame (kMaxRtuFrame bytes).
std::span<std::byte> rtu_pdu(std::span<std::byte> frame);

// Writes address and CRC around a PDU that already stands in rtu_pdu(); the length of the frame.
std::size_t seal_rtu(std::span<std::byte> frame, std::uint8_t address, std::size_t pdu_bytes);

// serve() for a frame: carries it out and writes the answer frame into `out` (kMaxRtuFrame bytes); its
// length. 0 for a broadcast: it is carried out if it writes, and answered by nobody.
std::size_t serve_rtu(DataModel& model, const RtuFrame& frame, std::span<std::byte> out);

}  // namespace stepwright::modbus::pdu
