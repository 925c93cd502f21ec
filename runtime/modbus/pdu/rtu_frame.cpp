#include "runtime/modbus/pdu/rtu_frame.h"

#include <cstring>

#include "runtime/modbus/pdu/crc16.h"
#include "runtime/modbus/pdu/serve.h"

namespace stepwright::modbus::pdu {
namespace {

constexpr std::size_t kCrc = 2;
constexpr std::size_t kShortest = 1 + 1 + kCrc;  // address, function, CRC
constexpr std::size_t kLongestUnknown = 64;      // of a frame whose function says no length
constexpr std::byte kReadFileRecord{20};
constexpr std::byte kWriteFileRecord{21};

// A length that is not known yet, and one that cannot be.
constexpr std::size_t kUnknown = 0;
constexpr std::size_t kNone = SIZE_MAX;

std::size_t with_byte_count(std::span<const std::byte> frame, std::size_t at) {
  if (frame.size() <= at) return kUnknown;
  const std::size_t length = at + 1 + std::to_integer<std::size_t>(frame[at]) + kCrc;
  return length <= kMaxRtuFrame ? length : kNone;
}

// How long the request is that begins here.
std::size_t request_length(std::span<const std::byte> frame) {
  if (frame.size() < 2) return kUnknown;
  if (frame[1] == kReadFileRecord || frame[1] == kWriteFileRecord) return with_byte_count(frame, 2);
  switch (static_cast<Function>(frame[1])) {
    case Function::ReadCoils:
    case Function::ReadDiscreteInputs:
    case Function::ReadHoldingRegisters:
    case Function::ReadInputRegisters:
    case Function::WriteSingleCoil:
    case Function::WriteSingleRegister:
      return 6 + kCrc;
    case Function::WriteMultipleCoils:
    case Function::WriteMultipleRegisters:
      return with_byte_count(frame, 6);
    case Function::MaskWriteRegister:
      return 8 + kCrc;
    case Function::ReadWriteMultipleRegisters:
      return with_byte_count(frame, 10);
    case Function::EncapsulatedInterface:
      if (frame.size() < 3) return kUnknown;
      return frame[2] == std::byte{0x0E} ? 5 + kCrc : kNone;
  }
  return kNone;
}

// How long another slave's answer is that begins here. FC 43 cannot be told from its first bytes: its frame
// is passed over as garbage.
std::size_t answer_length(std::span<const std::byte> frame) {
  if (frame.size() < 2) return kUnknown;
  if ((frame[1] & std::byte{0x80}) != std::byte{0}) return 3 + kCrc;
  switch (static_cast<Function>(frame[1])) {
    case Function::ReadCoils:
    case Function::ReadDiscreteInputs:
    case Function::ReadHoldingRegisters:
    case Function::ReadInputRegisters:
    case Function::ReadWriteMultipleRegisters:
      return with_byte_count(frame, 2);
    case Function::WriteSingleCoil:
    case Function::WriteSingleRegister:
    case Function::WriteMultipleCoils:
    case Function::WriteMultipleRegisters:
      return 6 + kCrc;
    case Function::MaskWriteRegister:
      return 8 + kCrc;
    case Function::EncapsulatedInterface:
      return kNone;
  }
  return kNone;
}

}  // namespace

void RtuReceiver::push(std::byte byte) {
  drop(given_);
  if (used_ == buffer_.size()) {
    drop(1);
    ++garbage_;
    lost_ = true;
  }
  buffer_[used_++] = byte;
}

RtuFrame RtuReceiver::take() {
  drop(given_);
  while (used_ > 0) {
    const Judged judged = judge();
    if (judged.judgement == Judgement::NeedsMore) break;
    if (judged.judgement == Judgement::Garbage) {
      drop(1);
      ++garbage_;
      lost_ = true;
      continue;
    }
    lost_ = false;
    const auto address = std::to_integer<std::uint8_t>(buffer_[0]);
    if (address != address_ && address != kBroadcast) {
      drop(judged.bytes);
      continue;
    }
    given_ = judged.bytes;
    return {address, std::span<const std::byte>(buffer_).subspan(1, judged.bytes - 1 - kCrc)};
  }
  return {};
}

void RtuReceiver::silence() {
  drop(given_);
  garbage_ += static_cast<std::uint32_t>(used_);
  used_ = 0;
  tried_ = 0;
  lost_ = false;
}

// What the bytes that are held begin with.
RtuReceiver::Judged RtuReceiver::judge() {
  const auto address = std::to_integer<std::uint8_t>(buffer_[0]);
  if (address != address_ && address != kBroadcast)
    return lost_ ? Judged{Judgement::Garbage, 0} : judge_other();
  const std::size_t length = request_length(held());
  if (length == kUnknown) return {};
  if (length != kNone) {
    if (used_ < length) return {};
    if (is_frame(length)) return {Judgement::Frame, length};
    return {Judgement::Garbage, 0};
  }
  return address == kBroadcast ? Judged{Judgement::Garbage, 0} : judge_unknown();
}

// A function that is not served has to be answered but says no length: its frame ends where the CRC is right.
RtuReceiver::Judged RtuReceiver::judge_unknown() {
  if (tried_ == 0) tried_crc_ = kCrcBegin;
  while (tried_ < used_) {
    tried_crc_ = crc16_add(tried_crc_, buffer_[tried_++]);
    if (tried_ >= kShortest && tried_crc_ == 0) return {Judgement::Frame, tried_};
    if (tried_ == kLongestUnknown) return {Judgement::Garbage, 0};
  }
  return {};
}

// A request to another slave, or its answer: whichever has a right CRC.
RtuReceiver::Judged RtuReceiver::judge_other() const {
  bool open = false;
  for (const std::size_t length : {request_length(held()), answer_length(held())}) {
    if (length == kNone) continue;
    if (length == kUnknown || used_ < length)
      open = true;
    else if (is_frame(length))
      return {Judgement::Frame, length};
  }
  return {open ? Judgement::NeedsMore : Judgement::Garbage, 0};
}

bool RtuReceiver::is_frame(std::size_t bytes) const {
  const std::uint16_t crc = crc16(held().first(bytes - kCrc));
  return buffer_[bytes - 2] == static_cast<std::byte>(crc & 0xFF) &&
         buffer_[bytes - 1] == static_cast<std::byte>(crc >> 8);
}

void RtuReceiver::drop(std::size_t bytes) {
  given_ = 0;
  if (bytes == 0) return;
  tried_ = 0;
  std::memmove(buffer_.data(), buffer_.data() + bytes, used_ - bytes);
  used_ -= bytes;
}

std::span<std::byte> rtu_pdu(std::span<std::byte> frame) {
  return frame.subspan(1, kMaxPdu);
}

std::size_t seal_rtu(std::span<std::byte> frame, std::uint8_t address, std::size_t pdu_bytes) {
  frame[0] = static_cast<std::byte>(address);
  const std::size_t covered = 1 + pdu_bytes;
  const std::uint16_t crc = crc16(frame.first(covered));
  frame[covered] = static_cast<std::byte>(crc & 0xFF);
  frame[covered + 1] = static_cast<std::byte>(crc >> 8);
  return covered + kCrc;
}

std::size_t serve_rtu(DataModel& model, const RtuFrame& frame, std::span<std::byte> out) {
  if (frame.broadcast()) {
    const Parsed parsed = parse(frame.pdu);
    if (parsed.exception == Exception::None && parsed.request.writes()) serve(model, frame.pdu, rtu_pdu(out));
    return 0;
  }
  const std::size_t bytes = serve(model, frame.pdu, rtu_pdu(out));
  return bytes == 0 ? 0 : seal_rtu(out, frame.address, bytes);
}

}  // namespace stepwright::modbus::pdu
